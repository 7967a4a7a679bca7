#include "aplomb/mesh/trim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb::test {
namespace {

/// The triangles that lie in the plane.
double area_at(const TriangleMesh& mesh, double z) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    if (a.z == z && b.z == z && c.z == z) area += 0.5 * norm(cross(b - a, c - a));
  }
  return area;
}

TEST(TrimBase, TakesACapOffASphere) {
  const auto trimmed = trim_base(solid_of(sphere({1, 2, 20}, 20, 6)), 3);
  ASSERT_TRUE(trimmed) << trimmed.error().message;
  const double h = 3, cap = M_PI * h * h * (3 * 20 - h) / 3;
  EXPECT_NEAR(trimmed->moments().volume_mm3, 4.0 / 3 * M_PI * 8000 - cap, 20);
  EXPECT_NEAR(trimmed->box().min.z, 3, 1e-3);
  EXPECT_NEAR(area_at(trimmed->mesh(), trimmed->box().min.z), M_PI * (2 * 20 * h - h * h), 1);
}

TEST(TrimBase, LeavesEveryTriangleAboveAsItWas) {
  const SolidMesh solid = solid_of(torus({0, 0, 0}, 30, 8, 60, 30));
  const auto trimmed = trim_base(solid, -5.5);
  ASSERT_TRUE(trimmed) << trimmed.error().message;
  const auto places = [](const TriangleMesh& mesh, const Triangle& t) {
    std::array<std::array<double, 3>, 3> out{};
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) out[corner][axis] = mesh.vertices[t[corner]][axis];
    return out;
  };
  std::map<std::array<std::array<double, 3>, 3>, int> left;
  for (const Triangle& t : trimmed->mesh().triangles) ++left[places(trimmed->mesh(), t)];
  for (const Triangle& t : solid.mesh().triangles) {
    const auto corners = places(solid.mesh(), t);
    if (std::ranges::all_of(corners, [](const auto& p) { return p[2] > -5.5; })) {
      EXPECT_EQ(left[corners], 1);
    }
  }
}

TEST(TrimBase, ClosesACutThroughSeveralLegsAndRings) {
  const SolidMesh ring = solid_of(torus({0, 0, 0}, 30, 8, 60, 30));  // the cut is a ring: a face with a hole
  const auto trimmed = trim_base(ring, -2);
  ASSERT_TRUE(trimmed) << trimmed.error().message;
  const double half = std::sqrt(64.0 - 4);
  EXPECT_NEAR(area_at(trimmed->mesh(), trimmed->box().min.z), M_PI * (std::pow(30 + half, 2) - std::pow(30 - half, 2)),
              25);
  const SolidMesh legs = solid_of(joined(box({0, 0, 0}, {10, 10, 50}), box({20, 0, 0}, {30, 10, 50})));
  const auto shorter = trim_base(legs, 5);
  ASSERT_TRUE(shorter) << shorter.error().message;
  EXPECT_NEAR(shorter->moments().volume_mm3, 2 * 100 * 45, 0.3);
  EXPECT_EQ(shorter->bodies(), 2u);
}

TEST(TrimBase, OpensAVoidThatTheCutMeets) {
  const SolidMesh hollow = solid_of(with_void(box({0, 0, 0}, {40, 40, 40}), box({10, 10, 5}, {30, 30, 30})));
  const auto trimmed = trim_base(hollow, 10);
  ASSERT_TRUE(trimmed) << trimmed.error().message;
  EXPECT_EQ(trimmed->voids(), 0u);
  EXPECT_NEAR(trimmed->moments().volume_mm3, 40 * 40 * 30 - 20 * 20 * 20, 2);
}

TEST(TrimBase, AvoidsAPlaneThroughVertices) {
  const SolidMesh prism = solid_of(joined(box({0, 0, 0}, {10, 10, 50}), box({20, 0, 5}, {30, 10, 50})));
  const auto trimmed = trim_base(prism, 5);
  ASSERT_TRUE(trimmed) << trimmed.error().message;
  EXPECT_LT(trimmed->box().min.z, 5);
  EXPECT_GT(trimmed->box().min.z, 4.999);
}

TEST(TrimBase, SaysWhenThereIsNothingToCut) {
  const SolidMesh solid = solid_of(sphere({0, 0, 20}, 20, 3));
  for (const double height : {-1.0, 41.0}) {
    const auto trimmed = trim_base(solid, height);
    ASSERT_FALSE(trimmed);
    EXPECT_EQ(trimmed.error().code, ErrorCode::unusable_input);
  }
}

}  // namespace
}  // namespace aplomb::test
