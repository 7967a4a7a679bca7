#pragma once

#include <numbers>

namespace aplomb::detail {

inline constexpr double degree = std::numbers::pi / 180;

/// The degrees that are this angle to the last bit, as short as they can be; of an angle given in radians the nearest.
double degrees_of(double angle_rad);

}  // namespace aplomb::detail
