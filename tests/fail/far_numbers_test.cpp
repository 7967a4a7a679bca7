// Lengths that integers inside cannot number are refused, not wrapped round.
#include <gtest/gtest.h>

#include "aplomb/adapters/clipper/polygon_operations.h"
#include "aplomb/mesh/solid_mesh.h"
#include "aplomb/volume/solid_volume.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

TEST(FarNumbers, OfANeedleOfSmallSurfaceAreOverBudget) {
  for (const Vec3 to : {Vec3{1e10, 1e-7, 1e-7}, Vec3{1e-7, 1e-7, 1e8}}) {
    const auto needle = check_solid(test::box({0, 0, 0}, to));
    ASSERT_TRUE(needle && needle->solid);
    const auto volume = voxelize(*needle->solid, {.wall_mm = 0.2, .voxel_mm = 0.1, .memory_bytes = 100'000'000});
    ASSERT_FALSE(volume.has_value());
    EXPECT_EQ(volume.error().code, ErrorCode::over_budget);
  }
}

TEST(FarNumbers, OfPolygonsAreClippersError) {
  for (const double far : {1e13, 1e300}) {
    const Polygons square{{{0, 0}, {far, 0}, {far, far}, {0, far}}};
    const auto common = adapters::intersection(square, square);
    ASSERT_FALSE(common.has_value());
    EXPECT_EQ(common.error().code, ErrorCode::third_party);
  }
}

}  // namespace
}  // namespace aplomb
