#pragma once

#include <array>

#include "aplomb/core/vec.h"

namespace aplomb::adapters {

using Corners = std::array<Vec3, 3>;

/// The plane of three points, of which many others are asked on which side they are.
class OrientedPlane {
 public:
  explicit OrientedPlane(const Corners& corners);

  /// The sign of det(b - a, c - a, d - a) for the corners a, b, c: +1 when d is on the side towards which they run
  /// counter-clockwise. Exact.
  int side_of(Vec3 d) const;

 private:
  Corners corners_;
  Vec3 normal_;     ///< (b - a) x (c - a)
  Vec3 permanent_;  ///< |p| + |q| where the normal has p - q
};

/// Exact; no triangle is degenerate. Touching counts.
bool triangles_meet(const Corners& a, const Corners& b);
bool triangle_meets_segment(const Corners& a, Vec3 from, Vec3 to);

/// Whether c and d lie on the same side of the line through a and b, all four coplanar; exact.
bool on_same_side(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

bool are_collinear(Vec3 a, Vec3 b, Vec3 c);

/// The sign of the signed area of three points seen along -z; exact.
int orientation_xy(Vec3 a, Vec3 b, Vec3 c);

}  // namespace aplomb::adapters
