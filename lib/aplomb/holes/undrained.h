#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/triangle_mesh.h"
#include "aplomb/printability/rules.h"

namespace aplomb {

/// A place of a drilled shell that fails by what a process asks of escape holes.
struct Undrained {
  Vec3 at_mm;  ///< in the empty space
  Box3 box_mm;
  bool is_cup = false;  ///< a suction cup; else a cavity
};

/// The cavities that fail void.closed, void.holes or void.hole_place, and the cups that fail void.cup, by the judge's
/// own measures; waived checks are not made.
///
/// \pre mesh bounds a solid. \return as find_cavities(), cut_slices() and measure_void_cup().
/// \par Cost  1 to 5 s for a figure of 100 mm.
Result<std::vector<Undrained>> undrained(const TriangleMesh& mesh, const Rules& rules, const Job& job = {});

}  // namespace aplomb
