#include "support/elephant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "aplomb/io/read_mesh.h"

namespace aplomb::test {

TriangleMesh elephant_on_small_feet(double foot_ratio) {
  auto file = read_mesh(std::filesystem::path(APLOMB_FIXTURES) / "elephant.stl");
  EXPECT_TRUE(file);
  if (!file) return {};
  TriangleMesh elephant = std::move(file->objects.front().mesh);
  constexpr double middle_mm = -3, belly_mm = 30;
  for (Vec3& v : elephant.vertices) {
    const double s = std::clamp(v.z / belly_mm, 0.0, 1.0);
    const double ratio = foot_ratio + (1 - foot_ratio) * s * s * (3 - 2 * s);
    v.x = middle_mm + ratio * (v.x - middle_mm);
    v.y *= ratio;
  }
  return elephant;
}

bool is_trunk(Vec3 v) { return v.x > 45 && v.z > 36 && std::abs(v.y) < 8; }
bool is_left_ear(Vec3 v) { return v.y > 19.5 && v.z > 38; }
bool is_right_ear(Vec3 v) { return v.y < -19.5 && v.z > 38; }

}  // namespace aplomb::test
