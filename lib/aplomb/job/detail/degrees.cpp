#include "aplomb/job/detail/degrees.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace aplomb::detail {

double degrees_of(double angle_rad) {
  const double nearest = angle_rad / degree;
  const double rounded = std::strtod(fmt::format("{:.12g}", nearest).c_str(), nullptr);
  for (const double candidate : {rounded, nearest, std::nextafter(nearest, -1e9), std::nextafter(nearest, 1e9)})
    if (candidate * degree == angle_rad) return candidate;
  return nearest;
}

}  // namespace aplomb::detail
