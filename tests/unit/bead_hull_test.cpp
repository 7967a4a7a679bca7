#include "aplomb/gcode/detail/bead_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aplomb::detail {
namespace {

constexpr double pi = std::numbers::pi;

double area(const std::vector<Vec2>& corners) {
  double doubled = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) doubled += cross(corners[i], corners[(i + 1) % corners.size()]);
  return doubled / 2;
}

double farthest_mm(const std::vector<Vec2>& corners) {
  double most = 0;
  for (const Vec2& corner : corners) most = std::max(most, norm(corner));
  return most;
}

Stroke arc_about_origin(double radius_mm, double from_rad, double sweep_rad) {
  const auto at = [&](double angle) { return Vec3{radius_mm * std::cos(angle), radius_mm * std::sin(angle), 0}; };
  return {
      .from_mm = at(from_rad), .to_mm = at(from_rad + sweep_rad), .arc = Arc{{0, 0}, radius_mm, from_rad, sweep_rad}};
}

TEST(BeadHull, ACircleInStepsHoweverSmallIsTheCircle) {
  for (const int steps : {100, 1'000, 20'000}) {
    BeadHull hull(512);
    Vec3 last{150, 0, 0};
    for (int i = 1; i <= steps; ++i) {
      const Vec3 next{150 * std::cos(2 * pi * i / steps), 150 * std::sin(2 * pi * i / steps), 0};
      hull.add({.from_mm = last, .to_mm = next}, 0.5);
      last = next;
    }
    const double circle_mm2 = pi * 150.25 * 150.25;
    EXPECT_LE(farthest_mm(hull.corners()), 150.25 + 1e-9) << steps;
    EXPECT_LT(area(hull.corners()), circle_mm2) << steps;
    EXPECT_GT(area(hull.corners()), circle_mm2 * (steps == 100 ? 0.999 : 0.9999)) << steps;
  }
}

TEST(BeadHull, AnArcReachesItsOuterEdgeAndNotBeyond) {
  for (const double sweep : {pi / 2, -pi / 2, pi, 2 * pi, -2 * pi, 0.01})
    for (const double radius : {0.1, 5.0, 100.0}) {
      BeadHull hull(512);
      for (int again = 0; again < 50; ++again) hull.add(arc_about_origin(radius, 3, sweep), 0.4);
      const double outer = radius + 0.2;
      double reached = -1e9;
      for (const Vec2& corner : hull.corners())
        reached = std::max(reached, dot(corner, {std::cos(3 + sweep / 2), std::sin(3 + sweep / 2)}));
      EXPECT_LE(farthest_mm(hull.corners()), outer + 1e-9) << sweep;
      EXPECT_GE(reached, outer * 0.9997 - 0.003) << sweep << " " << radius;
      if (std::abs(sweep) > 6) {
        EXPECT_GT(area(hull.corners()), pi * outer * outer * 0.99) << radius;
      }
    }
}

TEST(BeadHull, WhatTouchesABoxFromInsideChangesNothing) {
  BeadHull hull(512);
  const std::vector<Vec3> box{{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}, {0, 0, 0}};
  for (std::size_t i = 0; i + 1 < box.size(); ++i) hull.add({.from_mm = box[i], .to_mm = box[i + 1]}, 0.5);
  const double before = area(hull.corners());
  for (int i = 0; i < 2'000; ++i) hull.add({.from_mm = {0.01 * (i % 1999), 0, 0}, .to_mm = {0.005 * i, 10, 0}}, 0.5);
  EXPECT_NEAR(area(hull.corners()), before, 1e-3 * before);
  EXPECT_GE(area(hull.corners()), before - 1e-9);
}

}  // namespace
}  // namespace aplomb::detail
