#include "aplomb/mesh/detail/words.h"

#include <cmath>
#include <cstdio>

namespace aplomb::detail {

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string length(double mm) {
  char text[32];
  std::snprintf(text, sizeof text, mm < 10 ? "%.2g mm" : "%.0f mm", mm);
  return text;
}

std::string percent(double ratio) {
  char text[32];
  std::snprintf(text, sizeof text, std::abs(ratio) < 0.1 ? "%.1f %%" : "%.0f %%", 100 * ratio);
  return text;
}

std::string lost_parts(const Box3& before, const Box3& after) {
  constexpr double most_ratio = 0.015;
  const double most_mm = most_ratio * before.diagonal();
  if (norm(after.min - before.min) <= most_mm && norm(after.max - before.max) <= most_mm) return {};
  const auto sides = [](Vec3 size) { return length(size.x) + " x " + length(size.y) + " x " + length(size.z); };
  return "parts of it have no thickness: " + sides(before.size()) + " would become " + sides(after.size()) +
         "; thicken them in a modeller, or insist (--repair force)";
}

}  // namespace aplomb::detail
