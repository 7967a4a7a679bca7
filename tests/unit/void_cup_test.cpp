#include "aplomb/printability/void_cup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/prints.h"

namespace aplomb {
namespace {

const TriangleMesh outside = test::box({-20, -20, 0}, {20, 20, 40});

std::vector<Place> cups(const TriangleMesh& mesh, double layer_mm = 0.1, double turn_rad = 0) {
  const test::Print print = test::print_of(transformed(mesh, test::rotation({0, 0, 1}, turn_rad)), layer_mm);
  return measure_void_cup(print.printed, print.slices, Rules(Process::sla)).value();
}

double disc_mm2(double radius_mm) { return 32 * radius_mm * radius_mm * std::sin(2 * std::numbers::pi / 64); }

/// A mug with a hole in its floor, on three feet's worth of a rim: its floor is 3 mm up.
TriangleMesh drained_mug(double hole_mm) {
  return test::ring({{hole_mm, 3}, {8, 3}, {8, 0}, {10, 0}, {10, 20}, {8, 20}, {8, 5}, {hole_mm, 5}}, 64);
}

TEST(VoidCup, a_closed_void_is_one_of_its_largest_layer) {
  const std::vector<Place> found = cups(test::with_void(outside, test::box({-5, -4, 10}, {5, 4, 20})));
  ASSERT_EQ(found.size(), 1);
  EXPECT_NEAR(found.front().measured, 80, 1e-3);
  EXPECT_NEAR(found.front().box_mm.size().z, 10, 0.1001);
}

TEST(VoidCup, two_percent_around_the_area_shows_in_every_orientation_about_the_vertical) {
  const auto shaft = [](double area) {
    const double half = std::sqrt(area) / 2;
    return test::with_void(outside, test::box({-half, -half, 10}, {half, half, 20}));
  };
  for (const double turn : {0.0, 0.5, 2.5}) {
    EXPECT_LT(cups(shaft(0.98), 0.1, turn).front().measured, 1);
    EXPECT_GT(cups(shaft(1.02), 0.1, turn).front().measured, 1);
  }
}

TEST(VoidCup, what_is_lower_than_the_limit_by_a_layer_is_none) {
  for (const double layer_mm : {0.05, 0.1}) {
    const auto crack = [](double height) {
      return test::with_void(outside, test::box({-5, -4, 10}, {5, 4, 10 + height}));
    };
    EXPECT_TRUE(cups(crack(0.48 - layer_mm), layer_mm).empty());
    EXPECT_FALSE(cups(crack(0.52 + layer_mm), layer_mm).empty());
  }
}

TEST(VoidCup, a_mug_sucks_and_one_upside_down_does_not) {
  const TriangleMesh mug = test::lathe({{0, 0}, {10, 0}, {10, 20}, {8, 20}, {8, 2}, {0, 2}}, 64);
  ASSERT_EQ(cups(mug).size(), 1);
  EXPECT_NEAR(cups(mug).front().measured, disc_mm2(8), 1e-3);
  EXPECT_TRUE(cups(test::lathe({{0, 18}, {8, 18}, {8, 0}, {10, 0}, {10, 20}, {0, 20}}, 64)).empty());
}

TEST(VoidCup, a_hole_airs_it_but_not_a_leak) {
  EXPECT_TRUE(cups(drained_mug(0.5)).empty());
  ASSERT_EQ(cups(drained_mug(0.05)).size(), 1);
  EXPECT_NEAR(cups(drained_mug(0.05)).front().measured, disc_mm2(8), 1e-3);
}

TEST(VoidCup, two_that_unite_are_one) {
  // Two shafts under one room: a U turned over, as a void.
  const TriangleMesh legs =
      test::strip({{-15, 5}, {-15, 30}, {15, 30}, {15, 5}}, {{-5, 5}, {-5, 20}, {5, 20}, {5, 5}}, 8);
  const std::vector<Place> found = cups(test::with_void(outside, transformed(legs, test::translation({0, -4, 0}))));
  ASSERT_EQ(found.size(), 1);
  EXPECT_NEAR(found.front().measured, 30 * 8, 1e-3);
  EXPECT_NEAR(found.front().box_mm.min.z, 5, 0.1);
}

TEST(VoidCup, sound_shapes_have_none_and_other_processes_do_not_ask) {
  EXPECT_TRUE(cups(test::torus({0, 0, 6}, 20, 6, 64, 32)).empty());
  EXPECT_TRUE(cups(transformed(test::torus({}, 20, 6, 64, 32), test::rotation({1, 0, 0}, 1.5))).empty());
  EXPECT_TRUE(cups(test::star_prism(12, 10, 8, 20)).empty());
  const test::Print print = test::print_of(test::with_void(outside, test::box({-5, -4, 10}, {5, 4, 20})));
  EXPECT_TRUE(measure_void_cup(print.printed, print.slices, Rules(Process::fdm))->empty());
}

}  // namespace
}  // namespace aplomb
