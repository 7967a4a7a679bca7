#include "aplomb/core/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "aplomb/adapters/clipper/polygon_operations.h"

namespace aplomb {
namespace {

/// A ragged outline round a centre with a ragged hole in it.
Polygons ragged_ring(std::mt19937& random, Vec2 centre, double radius_mm, int corners) {
  std::uniform_real_distribution<double> ragged(0.5, 1);
  Polygons ring(2);
  for (int i = 0; i < corners; ++i) {
    const double turn = 2 * std::numbers::pi * i / corners, r = radius_mm * ragged(random);
    const Vec2 direction{std::cos(turn), std::sin(turn)};
    ring[0].push_back(centre + r * direction);
    ring[1].insert(ring[1].begin(), centre + 0.5 * r * direction);
  }
  return ring;
}

bool is_in(const Polygons& region, Vec2 p) {
  bool inside = false;
  for (const Polygon& loop : region) inside ^= encloses(loop, p);
  return inside;
}

TEST(PolygonProperty, thinning_outside_a_box_leaves_the_region_in_it_and_most_of_the_corners_out) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-12, 12), part(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Polygons region = ragged_ring(random, {anywhere(random), anywhere(random)}, 10, 200);
    const Vec2 corner{anywhere(random), anywhere(random)};
    const Box2 box{corner, corner + Vec2{6 * part(random), 6 * part(random)}};
    const Polygons thin = thinned_outside(region, box);
    for (int i = 0; i < 50; ++i) {
      const Vec2 p = box.min + Vec2{part(random) * (box.max.x - box.min.x), part(random) * (box.max.y - box.min.y)};
      EXPECT_EQ(is_in(thin, p), is_in(region, p)) << trial;
    }
  }
  const Polygons far_off = thinned_outside(ragged_ring(random, {}, 10, 200), {{6, 6}, {6.5, 6.5}});
  ASSERT_FALSE(far_off.empty());
  EXPECT_LT(far_off.front().size(), 40u);
}

TEST(PolygonProperty, the_part_in_a_half_plane_has_the_moments_of_the_region_clipped_to_it) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> anywhere(-8, 8), turn(0, 2 * std::numbers::pi);
  for (int trial = 0; trial < 200; ++trial) {
    const Polygons region = ragged_ring(random, {anywhere(random), anywhere(random)}, 10, 60);
    const double angle = turn(random);
    const HalfPlane half{anywhere(random), {std::cos(angle), std::sin(angle)}};
    const Polygon piece = clipped({{-30, -30}, {30, 30}}, half);
    PlaneMoments drawn;
    const Polygons common = adapters::intersection(region, {piece}).value();
    for (const Polygon& loop : common) drawn += plane_moments(loop);
    const PlaneMoments summed = plane_moments(region, half);
    EXPECT_NEAR(summed.area_mm2, drawn.area_mm2, 1e-4);
    EXPECT_NEAR(norm(summed.first_mm3 - drawn.first_mm3), 0, 2e-3);
    EXPECT_NEAR(summed.xx_mm4 + summed.yy_mm4, drawn.xx_mm4 + drawn.yy_mm4, 3e-2);
    const PlaneMoments other = plane_moments(region, {-half.constant, -1 * half.gradient});
    EXPECT_NEAR(summed.area_mm2 + other.area_mm2, area_mm2(region), 1e-9);
  }
}

TEST(PolygonProperty, a_half_plane_without_a_border_holds_all_or_nothing) {
  std::mt19937 random(17);
  const Polygons region = ragged_ring(random, {3, 4}, 10, 60);
  EXPECT_NEAR(plane_moments(region, {1e-9, {}}).area_mm2, area_mm2(region), 1e-9);
  EXPECT_EQ(plane_moments(region, {0, {}}).area_mm2, 0);
  EXPECT_NEAR(plane_moments(region, {1, {1e-14, 0}}).area_mm2, area_mm2(region), 1e-9);
  EXPECT_TRUE(clipped({{0, 0}, {1, 1}}, {-3, {1, 1}}).empty());
}

TEST(PolygonProperty, what_two_regions_share_and_what_they_do_not_add_up) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere(-8, 8), size(1, 12);
  for (int trial = 0; trial < 300; ++trial) {
    const Polygons a = ragged_ring(random, {anywhere(random), anywhere(random)}, size(random), 120);
    const Polygons b = ragged_ring(random, {anywhere(random), anywhere(random)}, size(random), 40);
    const double common = area_mm2(adapters::intersection(a, b).value());
    EXPECT_NEAR(common, area_mm2(adapters::intersection(b, a).value()), 1e-4);
    EXPECT_NEAR(common + area_mm2(adapters::difference(a, b).value()), area_mm2(a), 1e-4);
    EXPECT_NEAR(common + area_mm2(adapters::difference(b, a).value()), area_mm2(b), 1e-4);
  }
}

TEST(PolygonProperty, the_nearest_of_many_segments_is_as_far_as_the_foot_of_the_perpendicular_or_an_end) {
  const Segment flat{{0, 0}, {10, 0}}, point{{3, 4}, {3, 4}};
  EXPECT_DOUBLE_EQ(distance_mm({4, 3}, flat), 3);
  EXPECT_DOUBLE_EQ(distance_mm({13, 4}, flat), 5);
  EXPECT_DOUBLE_EQ(distance_mm({0, 0}, point), 5);
  EXPECT_DOUBLE_EQ(distance_mm({3, 3}, {flat, point}), 1);
  EXPECT_TRUE(std::isinf(distance_mm({}, std::vector<Segment>{})));
}

}  // namespace
}  // namespace aplomb
