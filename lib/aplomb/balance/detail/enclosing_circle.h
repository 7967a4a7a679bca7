#pragma once

#include <span>

#include "aplomb/core/vec.h"

namespace aplomb::detail {

struct Circle {
  Vec2 center_mm;
  double radius_mm = 0;
};

/// The smallest circle that holds the points and the disc. Exact to rounding; every point and the disc lie within the
/// result as computed.
Circle enclosing_circle(std::span<const Vec2> points_mm, const Circle& disc);

}  // namespace aplomb::detail
