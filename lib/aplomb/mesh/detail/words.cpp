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

}  // namespace aplomb::detail
