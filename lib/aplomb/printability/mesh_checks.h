#pragma once

#include <optional>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/solid_mesh.h"
#include "aplomb/printability/finding.h"

namespace aplomb {

/// How often each promise of a solid is broken, and about where: exact predicates, as check_solid() (SolidMesh). Every
/// list has one place, the first of its kind in the mesh, in a box round all of them.
struct MeshMeasures {
  std::vector<Place> manifold;      ///< open, flipped and overcrowded edges, vertices where parts only touch
  std::vector<Place> orientation;   ///< shells
  std::vector<Place> intersection;  ///< pairs of triangles
  std::vector<Place> degenerate;    ///< triangles

  std::optional<SolidMesh> solid;  ///< where nothing is wrong
};

/// \return unusable_input for a mesh without triangles; cancelled. \par Cost  twice that of check_solid() at most.
Result<MeshMeasures> measure_mesh(const TriangleMesh& mesh, const Job& job = {});

/// By how much the volume of what was read back differs from what was meant, relative to it; at least the same measure
/// of the area of 32 level sections. Infinity where triangles are missing.
double roundtrip_error_ratio(const TriangleMesh& meant, const TriangleMesh& read);

}  // namespace aplomb
