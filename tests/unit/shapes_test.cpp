#include "support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "aplomb/mesh/mass_properties.h"

namespace aplomb {
namespace {

constexpr double pi = std::numbers::pi;

bool every_edge_is_used_once_each_way(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : uses)
    if (count != 1 || !uses.contains({edge.second, edge.first})) return false;
  return !uses.empty();
}

void expect_near(Vec3 measured, Vec3 expected, double tolerance) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(measured[axis], expected[axis], tolerance);
}

double regular_polygon_area(double radius_mm, int segments) {
  return 0.5 * segments * radius_mm * radius_mm * std::sin(2 * pi / segments);
}

TEST(Shapes, EveryShapeIsClosedAndConsistentlyWound) {
  const TriangleMesh meshes[] = {test::box({0, 0, 0}, {1, 2, 3}),
                                 test::tetrahedron({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}),
                                 test::leaning_prism(2, 3, 4, 1),
                                 test::cylinder({}, 2, 3, 7),
                                 test::cone({}, 2, 3, 5),
                                 test::frustum({}, 0, 2, 3, 6),
                                 test::sphere({1, 2, 3}, 4, 2),
                                 test::torus({}, 5, 1, 9, 7),
                                 test::with_void(test::box({-2, -2, -2}, {2, 2, 2}), test::sphere({}, 1, 1))};
  for (const TriangleMesh& mesh : meshes) {
    EXPECT_TRUE(every_edge_is_used_once_each_way(mesh));
    EXPECT_GT(moments(mesh).volume_mm3, 0);
  }
}

TEST(Moments, OfABoxAreItsVolumeAndMiddle) {
  const Moments body = moments(test::box({1, 2, 3}, {3, 5, 7}));
  EXPECT_NEAR(body.volume_mm3, 24, 1e-12);
  expect_near(body.centroid_mm(), {2, 3.5, 5}, 1e-12);
}

TEST(Moments, OfATetrahedronAreItsDeterminantAndTheMeanOfItsCorners) {
  const Moments body = moments(test::tetrahedron({0, 0, 0}, {3, 0, 0}, {0, 5, 0}, {1, 1, 7}));
  EXPECT_NEAR(body.volume_mm3, 3 * 5 * 7 / 6.0, 1e-12);
  expect_near(body.centroid_mm(), {1, 1.5, 1.75}, 1e-12);
}

TEST(Moments, OfAFrustumFollowTheClosedForm) {
  const double r = 5, s = 2, h = 8;
  const Moments body = moments(test::frustum({1, -2, 3}, r, s, h, 40));
  const double polygon = regular_polygon_area(1, 40);
  EXPECT_NEAR(body.volume_mm3, polygon * h / 3 * (r * r + r * s + s * s), 1e-9);
  const double height = h / 4 * (r * r + 2 * r * s + 3 * s * s) / (r * r + r * s + s * s);
  expect_near(body.centroid_mm(), {1, -2, 3 + height}, 1e-12);
}

TEST(Moments, OfASphereAndATorusConvergeToTheClosedForms) {
  const Moments ball = moments(test::sphere({1, 2, 3}, 10, 5));
  EXPECT_NEAR(ball.volume_mm3, 4 * pi / 3 * 1000, 5);
  expect_near(ball.centroid_mm(), {1, 2, 3}, 1e-9);
  const Moments ring = moments(test::torus({1, 2, 3}, 10, 3, 400, 200));
  EXPECT_NEAR(ring.volume_mm3, 2 * pi * pi * 10 * 9, 1);
  expect_near(ring.centroid_mm(), {1, 2, 3}, 1e-9);
}

TEST(Moments, OfABodyWithAVoidAreTheDifference) {
  const TriangleMesh outer = test::box({-5, -5, -5}, {5, 5, 5}), inner = test::sphere({1, 1, 1}, 2, 3);
  const Moments expected = moments(outer) - moments(inner), body = moments(test::with_void(outer, inner));
  EXPECT_NEAR(body.volume_mm3, expected.volume_mm3, 1e-10);
  expect_near(body.first_mm4, expected.first_mm4, 1e-9);
}

TEST(Moments, KeepTheirDigitsFarFromTheOrigin) {
  const Vec3 far{1e5, -1e5, 1e5};
  const TriangleMesh near_mesh = test::leaning_prism(10, 12, 30, 7);
  const Moments near_body = moments(near_mesh), far_body = moments(transformed(near_mesh, test::translation(far)));
  EXPECT_NEAR(far_body.volume_mm3, near_body.volume_mm3, 1e-7);
  expect_near(far_body.centroid_mm() - far, near_body.centroid_mm(), 1e-9);
}

}  // namespace
}  // namespace aplomb
