#pragma once

#include <vector>

#include "aplomb/core/vec.h"

namespace aplomb::detail {

/// The corners of the convex hull, counter-clockwise from the leftmost (then lowest), points on its edges
/// left out. Points in line to rounding give the two ends; points that coincide to rounding give one.
std::vector<Vec2> convex_hull(std::vector<Vec2> points_mm);

}  // namespace aplomb::detail
