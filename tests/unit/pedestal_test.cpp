#include "aplomb/balance/pedestal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "support/shapes.h"

namespace aplomb {
namespace {

SupportPolygon support_with(std::vector<Vec2> corners) {
  SupportPolygon support;
  support.corners_mm = std::move(corners);
  return support;
}

/// The pedestal of 0 thickness for a centre of mass at `com`, height 1, that asks for a reach of reach_mm about it.
Pedestal pedestal_for(const SupportPolygon& support, Vec2 com, double reach_mm) {
  Stability stability;
  stability.com_mm = {com.x, com.y, 1};
  stability.com_height_mm = 1;
  return smallest_pedestal(support, stability, {.required_tip_rad = std::atan(reach_mm)}, 0);
}

double needed_radius_mm(const SupportPolygon& support, Vec2 com, double reach_mm, Vec2 center) {
  double radius = norm(com - center) + reach_mm;
  for (const Vec2& corner : support.corners_mm) radius = std::max(radius, norm(corner - center));
  return radius;
}

/// A compass search over centres: the needed radius is convex in the centre.
double least_radius_by_search_mm(const SupportPolygon& support, Vec2 com, double reach_mm) {
  Vec2 center = com;
  double step = 30, best = needed_radius_mm(support, com, reach_mm, center);
  while (step > 1e-9) {
    bool improved = false;
    for (int k = 0; k < 16; ++k) {
      const double angle = k * std::numbers::pi / 8;
      const Vec2 next = center + step * Vec2{std::cos(angle), std::sin(angle)};
      const double radius = needed_radius_mm(support, com, reach_mm, next);
      if (radius < best) best = radius, center = next, improved = true;
    }
    if (!improved) step /= 2;
  }
  return best;
}

TEST(Pedestal, IsTheDiscAboutTheCentreOfMassWhereThatCoversTheContacts) {
  const Pedestal p = pedestal_for(support_with({{0, 0}, {1, 0}, {0, 1}}), {0.5, 0.25}, 5);
  EXPECT_NEAR(p.radius_mm, 5, 1e-12);
  EXPECT_NEAR(p.center_mm.x, 0.5, 1e-12);
  EXPECT_NEAR(p.center_mm.y, 0.25, 1e-12);
}

TEST(Pedestal, IsTheSmallestCircleAroundTheContactsWhereTheCentreOfMassNeedsLess) {
  const Pedestal p = pedestal_for(support_with({{0, 0}, {10, 0}, {5, 1}}), {5, 0.2}, 0.5);
  EXPECT_NEAR(p.radius_mm, 5, 1e-12);
  EXPECT_NEAR(p.center_mm.x, 5, 1e-12);
}

TEST(Pedestal, OfRegularPolygonsIsTheirCircumcircle) {
  const SupportPolygon support = support_with(test::regular_polygon(7, 60));
  EXPECT_NEAR(pedestal_for(support, {0, 0}, 1).radius_mm, 7, 1e-12);
}

TEST(Pedestal, IsNeverLargerThanASearchFindsAndAlwaysLargeEnough) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-10, 10), reach(0, 15);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec2> corners;
    for (int k = 0; k < 1 + trial % 9; ++k) corners.push_back({coordinate(random), coordinate(random)});
    const SupportPolygon support = support_with(corners);
    const Vec2 com{coordinate(random), coordinate(random)};
    const double reach_mm = reach(random);
    const Pedestal p = pedestal_for(support, com, reach_mm);
    EXPECT_LE(p.radius_mm, least_radius_by_search_mm(support, com, reach_mm) + 1e-7);
    EXPECT_GE(p.radius_mm, needed_radius_mm(support, com, reach_mm, {p.center_mm.x, p.center_mm.y}) - 1e-9);
  }
}

TEST(Pedestal, GivesExactlyTheRequiredTipAngleWhenTheFigureStandsOnIt) {
  const TriangleMesh figure = test::leaning_prism(10, 10, 40, 16);
  const StandingPose pose;
  const Region body{moments(figure), 1.24};
  const SupportPolygon support = support_polygon(figure, pose).value();
  const Pedestal p = smallest_pedestal(support, measure_stability(support, {&body, 1}, pose), pose, 3);
  const TriangleMesh disc = test::cylinder(p.center_mm - Vec3{0, 0, 3}, p.radius_mm, 3, 2000);
  const SupportPolygon wider = support_polygon(joined(figure, disc), pose).value();
  EXPECT_NEAR(measure_stability(wider, {&body, 1}, pose).tip_rad, pose.required_tip_rad, 1e-4);
}

}  // namespace
}  // namespace aplomb
