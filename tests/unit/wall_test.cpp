#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "aplomb/mesh/detail/triangle_distance.h"
#include "aplomb/shell/wall.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

using detail::TrianglePoints;

TrianglePoints random_triangle(std::mt19937& random, double spread) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Vec3{coordinate(random), coordinate(random), coordinate(random)}; };
  const Vec3 center = spread * point();
  return {center + point(), center + point(), center + point()};
}

/// Alternating projections between two convex sets end at their distance.
double projected_distance(const TrianglePoints& a, const TrianglePoints& b) {
  const auto nearest = [](Vec3 p, const TrianglePoints& t) {
    const Vec3 w = detail::closest_barycentric(p, t);
    return w.x * t[0] + w.y * t[1] + w.z * t[2];
  };
  Vec3 on_a = a[0], on_b;
  for (int i = 0; i < 20'000; ++i) {
    on_b = nearest(on_a, b);
    on_a = nearest(on_b, a);
  }
  return norm(on_a - on_b);
}

TEST(TriangleDistance, it_is_what_alternating_projections_converge_to) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const TrianglePoints a = random_triangle(random, 2), b = random_triangle(random, 2);
    const double distance = std::sqrt(detail::squared_distance(a, b));
    EXPECT_NEAR(distance, projected_distance(a, b), 1e-3);
    EXPECT_DOUBLE_EQ(distance, std::sqrt(detail::squared_distance(b, a)));
  }
}

TEST(TriangleDistance, triangles_that_pierce_are_not_apart) {
  const TrianglePoints flat{Vec3{-9, -9, 0}, Vec3{9, -9, 0}, Vec3{0, 9, 0}};
  EXPECT_EQ(detail::squared_distance(flat, {Vec3{0, 0, -5}, Vec3{1, 0, 5}, Vec3{-1, 1, 5}}), 0);
  EXPECT_DOUBLE_EQ(detail::squared_distance(flat, {Vec3{0, 0, 2}, Vec3{1, 0, 5}, Vec3{-1, 1, 5}}), 4);
}

TEST(Wall, between_two_boxes_it_is_the_least_gap_however_large_the_faces) {
  const TriangleMesh outer = test::box({0, 0, 0}, {100, 80, 60});
  const WallMeasure wall = *measure_wall(test::box({3, 4, 5}, {98.5, 75, 50}), outer, 1);
  EXPECT_LE(wall.least_mm, 1.5);
  EXPECT_GE(wall.least_mm, 1.5 * (1 - 1e-4));
  EXPECT_TRUE(wall.thin.empty());
}

TEST(Wall, an_edge_that_passes_an_edge_is_measured_between_their_ends) {
  // Two ridges at right angles, 2 apart at their middles and far from all corners.
  const TriangleMesh lower = test::tetrahedron({-50, 0, 0}, {50, 0, 0}, {0, -20, -40}, {0, 20, -40});
  const TriangleMesh upper = test::tetrahedron({0, -50, 2}, {0, 50, 2}, {-20, 0, 42}, {20, 0, 42});
  EXPECT_NEAR(measure_wall(upper, lower, 1)->least_mm, 2, 2e-4);
  EXPECT_FALSE(measure_wall(upper, lower, 2.1)->thin.empty());
}

TEST(Wall, the_triangles_nearer_than_required_are_named) {
  const TriangleMesh outer = test::box({0, 0, 0}, {100, 80, 60});
  const TriangleMesh inner = test::box({3, 4, 5}, {98.5, 75, 50});
  const WallMeasure wall = *measure_wall(inner, outer, 2);
  std::vector<std::uint32_t> expected;  // those that touch the plane x = 98.5
  for (std::uint32_t i = 0; i < inner.triangles.size(); ++i)
    for (const std::uint32_t v : inner.triangles[i])
      if (inner.vertices[v].x == 98.5 && (expected.empty() || expected.back() != i)) expected.push_back(i);
  EXPECT_EQ(wall.thin, expected);
}

TEST(Wall, of_concentric_spheres_it_is_that_of_their_polyhedra_and_moves_with_them) {
  const TriangleMesh outer = test::sphere({}, 20, 4), inner = test::sphere({}, 17, 3);
  const double wall = measure_wall(rounded_to_float(inner), rounded_to_float(outer), 1)->least_mm;
  EXPECT_LT(wall, 3);
  EXPECT_GT(wall, 2.9);
  const Affine3 turn = test::rotation({1, 2, 3}, 1);
  const auto turned = [&](const TriangleMesh& mesh) { return rounded_to_float(transformed(mesh, turn)); };
  EXPECT_NEAR(measure_wall(turned(inner), turned(outer), 1)->least_mm, wall, 2e-4 * wall);
}

TEST(Wall, surfaces_that_cross_have_none) {
  const WallMeasure wall = *measure_wall(test::box({-1, 4, 5}, {50, 75, 50}), test::box({0, 0, 0}, {100, 80, 60}), 1);
  EXPECT_LE(wall.least_mm, 0);
}

}  // namespace
}  // namespace aplomb
