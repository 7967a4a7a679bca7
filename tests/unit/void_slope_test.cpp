#include "aplomb/printability/void_slope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/prints.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;
const TriangleMesh outside = test::box({-60, -60, -60}, {60, 60, 60});

std::vector<Place> slopes(const TriangleMesh& inner, Process process, double turn_rad = 0) {
  const TriangleMesh mesh = transformed(test::with_void(outside, inner), test::rotation({0, 0, 1}, turn_rad));
  const test::Print print = test::print_of(mesh, 1);
  return measure_void_slope(print.printed, print.slices, Rules(process)).value();
}

/// A void under a roof whose facets rise at an angle from level.
TriangleMesh roof(double slope_deg, double radius_mm) {
  const double apothem = radius_mm * std::cos(std::numbers::pi / 96);
  return test::lathe({{0, -20}, {radius_mm, -20}, {0, -20 + apothem * std::tan(slope_deg * degree)}}, 96);
}

TEST(VoidSlope, a_roof_measures_its_slope_and_two_percent_around_the_limit_shows) {
  for (const auto& [process, limit] : {std::pair{Process::fdm, 45.0}, {Process::sla, 19.0}})
    for (const double turn : {0.0, 0.3, 1.7})
      for (const double factor : {0.98, 1.02}) {
        const std::vector<Place> found = slopes(roof(factor * limit, 20), process, turn);
        ASSERT_EQ(found.size(), 1);
        EXPECT_NEAR(found.front().measured, factor * limit, 1e-3);
      }
}

TEST(VoidSlope, a_flat_ceiling_within_the_span_of_a_bridge_is_none_but_in_resin) {
  const auto slot = [](double width) { return test::box({-width / 2, -15, 10}, {width / 2, 15, 30}); };
  for (const double turn : {0.0, 0.3, std::numbers::pi / 4}) {
    EXPECT_TRUE(slopes(slot(9.8), Process::fdm, turn).empty());
    ASSERT_FALSE(slopes(slot(10.2), Process::fdm, turn).empty());
    EXPECT_NEAR(slopes(slot(10.2), Process::fdm, turn).front().measured, 0, 1e-3);
    EXPECT_NEAR(slopes(slot(9.8), Process::sla, turn).front().measured, 0, 1e-3);
  }
}

TEST(VoidSlope, a_low_roof_that_is_narrow_bridges_too) {
  EXPECT_TRUE(slopes(roof(30, 4.9), Process::fdm).empty());
  EXPECT_NEAR(slopes(roof(30, 5.1), Process::fdm).front().measured, 30, 1e-3);
}

TEST(VoidSlope, a_ledge_rests_only_where_the_surface_goes_down) {
  const auto ledge = [](double reach) {
    return test::lathe({{0, 5}, {20, 5}, {20, 15}, {20 - reach, 15}, {20 - reach, 25}, {0, 25 + 25.0}}, 96);
  };
  EXPECT_GT(slopes(ledge(4.9), Process::fdm).front().measured, 45);
  EXPECT_NEAR(slopes(ledge(5.1), Process::fdm).front().measured, 0, 1e-3);
}

TEST(VoidSlope, less_than_a_square_millimetre_is_no_finding) {
  const auto blunt = [](double radius) { return test::lathe({{0, 0}, {10, 0}, {radius, 20}, {0, 20}}, 64); };
  EXPECT_GT(slopes(blunt(0.5), Process::sla).front().measured, 60);
  EXPECT_NEAR(slopes(blunt(0.6), Process::sla).front().measured, 0, 1e-3);
}

TEST(VoidSlope, floors_and_walls_are_no_ceilings_and_a_ball_is_as_flat_as_its_top) {
  EXPECT_NEAR(slopes(test::sphere({}, 20, 4), Process::fdm).front().measured, 1.6, 1);
  EXPECT_NEAR(slopes(test::box({-30, -30, -30}, {30, 30, 30}), Process::fdm).front().at_mm.z, 30, 1e-6);
}

TEST(VoidSlope, of_a_turned_cone_it_is_that_of_its_lowest_line) {
  // A cone of half-angle 20 degrees lying on its side at an axis 50 degrees from level: its ceiling is at 30 to 70
  // degrees.
  const TriangleMesh cone =
      transformed(test::cone({0, 0, -20}, 14, 14 / std::tan(20 * degree), 256), test::rotation({0, 1, 0}, 40 * degree));
  EXPECT_NEAR(slopes(cone, Process::sla).front().measured, 30, 0.2);
}

}  // namespace
}  // namespace aplomb
