#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "aplomb/adapters/embree/surface_distance.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

using adapters::SurfaceDistance;

/// Points round a mesh, near and far, by a fixed seed.
std::vector<Vec3> points_round(const TriangleMesh& mesh, int count) {
  std::mt19937 random(7);
  const Box3 box = bounding_box(mesh);
  std::uniform_real_distribution<double> share(-0.3, 1.3);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = box.min[axis] + share(random) * box.size()[axis];
    points.push_back(p);
  }
  return points;
}

std::vector<TriangleMesh> shapes() {
  const TriangleMesh star = test::star_prism(7, 20, 6, 15), ball = test::sphere({1, 2, 3}, 10, 3);
  return {test::box({-1, -2, -3}, {4, 5, 6}),
          star,
          ball,
          test::torus({0, 0, 0}, 10, 3, 24, 12),
          test::with_void(ball, test::sphere({1, 2, 3}, 4, 1)),
          test::tetrahedron({0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0.1, 0.1, 0.3})};
}

TEST(SurfaceDistance, IsTheLeastOverAllTriangles) {
  for (const TriangleMesh& shape : shapes()) {
    const TriangleMesh mesh = rounded_to_float(shape);
    const SurfaceDistance surface(mesh);
    for (const Vec3 p : points_round(mesh, 300))
      EXPECT_NEAR(surface.closest(p).distance_mm, test::brute_force_distance_mm(mesh, p), 1e-12);
  }
}

TEST(SurfaceDistance, IsTheLeastOverAllTrianglesFarFromTheOrigin) {
  for (const TriangleMesh& shape : shapes()) {
    const TriangleMesh mesh = rounded_to_float(transformed(shape, test::translation({1e5, -1e5, 1e5})));
    const SurfaceDistance surface(mesh);
    for (const Vec3 p : points_round(mesh, 300))
      EXPECT_NEAR(surface.closest(p).distance_mm, test::brute_force_distance_mm(mesh, p), 1e-10);
  }
}

TEST(SurfaceDistance, DoesNotDependOnTheHint) {
  const TriangleMesh mesh = rounded_to_float(test::star_prism(7, 20, 6, 15));
  const SurfaceDistance surface(mesh);
  for (const Vec3 p : points_round(mesh, 300))
    for (std::uint32_t hint = 0; hint < mesh.triangles.size(); hint += 5)
      EXPECT_EQ(surface.closest(p, hint).distance_mm, surface.closest(p).distance_mm);
}

TEST(SurfaceDistance, NeedOnlyTellThatItIsNearEnough) {
  const TriangleMesh mesh = rounded_to_float(test::sphere({1, 2, 3}, 10, 3));
  const SurfaceDistance surface(mesh);
  for (const Vec3 p : points_round(mesh, 300)) {
    const double exact = surface.closest(p).distance_mm;
    EXPECT_EQ(surface.closest(p, 5, 0.99 * exact).distance_mm, exact);
    const double near_enough = surface.closest(p, 5, 1.5 * exact).distance_mm;
    EXPECT_TRUE(exact <= near_enough && near_enough <= 1.5 * exact);
  }
}

TEST(SurfaceDistance, ToABoxIsTheClosedForm) {
  const Vec3 size{4, 6, 8};
  const SurfaceDistance surface(test::box({0, 0, 0}, size));
  for (const Vec3 p : points_round(test::box({0, 0, 0}, size), 1000)) {
    Vec3 beyond;
    double depth = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      beyond[axis] = std::max({0.0, -p[axis], p[axis] - size[axis]});
      depth = std::min({depth, p[axis], size[axis] - p[axis]});
    }
    EXPECT_NEAR(surface.closest(p).distance_mm, depth > 0 ? depth : norm(beyond), 1e-12);
  }
}

TEST(SurfaceDistance, KnowsInsideFromOutsideAsTheSolidAnglesDo) {
  for (const TriangleMesh& shape : shapes())
    for (const double shift : {0.0, 1e5}) {
      const TriangleMesh mesh = rounded_to_float(transformed(shape, test::translation({shift, shift, -shift})));
      const SurfaceDistance surface(mesh);
      for (const Vec3 p : points_round(mesh, 500)) {
        const auto nearest = surface.closest(p);
        if (nearest.distance_mm < 1e-6) continue;
        EXPECT_EQ(surface.inside(p, nearest), test::is_inside(mesh, p));
      }
    }
}

/// Points whose closest feature is a vertex or an edge: displaced from it in every direction.
TEST(SurfaceDistance, KnowsInsideFromOutsideRoundEdgesAndVertices) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (const TriangleMesh& shape : shapes()) {
    const TriangleMesh mesh = rounded_to_float(shape);
    const SurfaceDistance surface(mesh);
    for (int i = 0; i < 1000; ++i) {
      const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
      const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]];
      const Vec3 on_feature = i % 2 == 0 ? a : 0.5 * (a + b);
      const Vec3 p = on_feature + 1e-3 * normalized(Vec3{normal(random), normal(random), normal(random)});
      const auto nearest = surface.closest(p);
      if (nearest.distance_mm < 1e-7) continue;
      EXPECT_EQ(surface.inside(p, nearest), test::is_inside(mesh, p));
    }
  }
}

}  // namespace
}  // namespace aplomb
