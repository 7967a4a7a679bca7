#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// A connected piece of the voids' ceilings, seen from above on a raster.
struct FlatCeiling {
  Box3 box_mm;
  Vec2 origin_mm;  ///< middle of cell (0, 0)
  double cell_mm = 1;
  int columns = 0, rows = 0;
  std::vector<double> top_mm;  ///< of each cell, rows one after the other; -infinity where the ceiling is not

  bool holds(int cell) const {
    return top_mm[static_cast<std::size_t>(cell)] > -std::numeric_limits<double>::infinity();
  }
  Vec2 middle_mm(int cell) const {
    const int column = cell % columns, row = cell / columns;
    return {origin_mm.x + cell_mm * column, origin_mm.y + cell_mm * row};
  }
};

/// The pieces of ceiling that are flatter than slope_deg: facets of the voids (from first_triangle on) that face down
/// into them, connected by their corners. Pieces under 0.5 mm2 are left out.
///
/// \par Cost  O(triangles + cells).
std::vector<FlatCeiling> flat_ceilings(const TriangleMesh& shell, std::size_t first_triangle, double slope_deg,
                                       double cell_mm);

/// The cells of the ceiling, ascending, that lie in a circle of this radius that fits into it.
std::vector<int> wide_cells(const FlatCeiling& ceiling, double radius_mm);

}  // namespace aplomb
