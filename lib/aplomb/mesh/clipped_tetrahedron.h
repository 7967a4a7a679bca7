#pragma once

#include <array>

#include "aplomb/mesh/mass_properties.h"

namespace aplomb {

/// Moments of the part of a tetrahedron where the linear function with the given corner values is negative.
/// Exact: one or two corners cut off, or a wedge as three tetrahedra. The tetrahedron's own orientation is of no
/// account.
Moments negative_part(const std::array<Vec3, 4>& corners, const std::array<double, 4>& values);

/// The same of the unit cube, split as marching_tetrahedra() splits its cells (Kuhn), the function linear on each of
/// the six. Corner c of the cube is (c & 1, c >> 1 & 1, c >> 2 & 1).
Moments negative_part_of_unit_cube(const std::array<double, 8>& values);

}  // namespace aplomb
