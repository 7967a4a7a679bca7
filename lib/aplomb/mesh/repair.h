#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/solid_mesh.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

struct RepairOptions {
  /// Accept a solid of which most had to be made up (an open or crumbled surface).
  bool insist = false;
  /// The share of the surface that may be patches before only `insist` helps; in (0, 1].
  double most_patched_ratio = 0.25;
  /// Limits of each step that runs in a child process, because it may crash or never end; 0 s skips those steps.
  double step_seconds = 20;
  std::size_t step_memory_mb = 4096;
  /// Fineness of the last resort, on the diagonal of the box; 32 to 1000.
  int remesh_voxels = 200;
};

/// A sentence naming field, value and range; empty when there is no problem.
std::string find_problem(const RepairOptions& options);

enum class RepairMethod {
  none,      ///< nothing was wrong
  soup,      ///< triangles re-wound, left out, sewn or patched; the others are as they were
  local,     ///< crossing bodies united or crossing regions cut out and filled; the rest is as it was
  remeshed,  ///< the whole surface rebuilt from a grid, within about a voxel
};

/// "none", "soup", "local" or "remeshed".
const char* name_of(RepairMethod method);

struct RepairReport {
  MeshDefects found;               ///< after vertices at equal places were made one
  std::vector<std::string> steps;  ///< sentences: what was wrong, what was decided
  RepairMethod method = RepairMethod::none;
  bool outer_unchanged = true;   ///< the solid has exactly the triangles of the input
  double volume_before_mm3 = 0;  ///< enclosed by the input as it was wound; open surfaces about their box's centre
  double volume_after_mm3 = 0;
  double max_deviation_mm = 0;  ///< the largest distance of the solid's surface from the input's
  double patched_ratio = 0;     ///< the share of the surface that is patches over holes
};

struct Repaired {
  SolidMesh solid;
  RepairReport report;
  PrintNumbers prints;  ///< of the solid's triangles
};

/// Makes a solid of a mesh that may have any defect, changing as little as does, and says what it did:
/// first the soup (weld, degenerate and duplicate triangles, T-junctions, winding, nesting, holes), then crossings
/// where they are, at last the whole surface from a grid. What crossings do is judged against the grid: a repair that
/// is valid but another solid is thrown away.
///
/// Nested shells: wound against the solid around them they are voids and stay; wound like it they add nothing under the
/// positive fill rule of 3MF and are left out.
///
/// \pre  find_problem(options) is empty.
/// \post When nothing was wrong the triangles are the given ones (rounded to float32).
/// \return unusable_input with the reason and the remedy: empty, no volume, or most of it would be made up;
///         cancelled.
/// \par Cost  That of check_solid() when nothing is wrong; else 0.1 to 10 s, bounded by three steps' limits.
Result<Repaired> repair(const TriangleMesh& mesh, const RepairOptions& options = {}, const Job& job = {});

}  // namespace aplomb
