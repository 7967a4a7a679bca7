#pragma once

#include <array>
#include <vector>

#include "aplomb/balance/pose.h"
#include "aplomb/core/vec.h"

namespace aplomb::detail {

/// A triangle's part that is no higher than a given height, or the whole triangle: three or four corners.
using ConvexPiece = std::vector<Vec3>;

/// Points whose convex hull is that of (piece within the ball), the rim taken as a 128-gon inside it.
/// \pre The piece is planar and convex; ball.radius_mm > 0.
std::vector<Vec3> extreme_points_in_ball(const ConvexPiece& piece, const Contact& ball);

/// False when the ball misses the triangle's bounding box.
bool may_touch(const std::array<Vec3, 3>& corners, const Contact& ball);

/// Where the segment crosses the given height. The same point, bit for bit, for every triangle that shares
/// the edge. \pre low_mm <= height_mm < high_mm.
inline Vec3 crossing(Vec3 low, double low_mm, Vec3 high, double high_mm, double height_mm) {
  return low + ((height_mm - low_mm) / (high_mm - low_mm)) * (high - low);
}

/// The part of the triangle at or below height_mm; heights_mm are those of its corners.
ConvexPiece part_below(const std::array<Vec3, 3>& corners, const std::array<double, 3>& heights_mm, double height_mm);

}  // namespace aplomb::detail
