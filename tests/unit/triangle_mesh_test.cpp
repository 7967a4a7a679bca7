// Operations on bare triangle meshes.
#include "aplomb/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

namespace aplomb::test {
namespace {

TEST(TriangleMesh, EveryCoordinateIsRoundedToFloatHoweverManyThereAre) {
  for (std::size_t count = 1; count < 20; ++count) {
    const TriangleMesh mesh = rounded_to_float({std::vector<Vec3>(count, {0.1, 0.2, 0.3}), {}});
    for (const Vec3& vertex : mesh.vertices) EXPECT_EQ(vertex, (Vec3{0.1f, 0.2f, 0.3f})) << count;
  }
}

}  // namespace
}  // namespace aplomb::test
