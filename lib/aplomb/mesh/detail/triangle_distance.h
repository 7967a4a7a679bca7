#pragma once

#include <array>

#include "aplomb/core/vec.h"

namespace aplomb::detail {

using TrianglePoints = std::array<Vec3, 3>;

/// Barycentric coordinates of the point of a triangle closest to p: exact zeros name the feature (Ericson, Real-Time
/// Collision Detection, 5.1.5).
Vec3 closest_barycentric(Vec3 p, const TrianglePoints& triangle);

/// Between two triangles, 0 when they meet. \pre Neither is degenerate.
double squared_distance(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace aplomb::detail
