#include "aplomb/printability/strength_ankle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/prints.h"

namespace aplomb {
namespace {

constexpr double push_n = 10, newton_per_g = 9.80665e-3;
constexpr double weightless = 1e-9;

std::vector<Place> ankles(const TriangleMesh& mesh, double density = weightless, double layer_mm = 0.2,
                          Process process = Process::fdm) {
  const test::Print print = test::print_of(mesh, layer_mm);
  return measure_strength_ankle(print.printed, print.slices, Rules(process), density).value();
}

TEST(StrengthAnkle, a_box_pushed_at_its_top_bends_as_a_cantilever_whichever_way_it_is_turned) {
  for (const double layer_mm : {0.1, 0.2})
    for (const double turn : {0.0, 0.5, 1.2}) {
      const TriangleMesh post = test::box({-2, -4, 0}, {2, 4, 80});
      const Place worst = ankles(transformed(post, test::rotation({0, 0, 1}, turn)), weightless, layer_mm).front();
      // The worst push is skew: |J^-1 q| at a corner.
      const double over_xx = 2 / (8 * 64 / 12.0), over_yy = 4 / (4 * 512 / 12.0);
      const double exact = push_n * (80 - worst.at_mm.z) * std::hypot(over_xx, over_yy);
      EXPECT_NEAR(worst.measured, exact, 0.002 * exact);
      EXPECT_NEAR(worst.at_mm.z, std::sqrt(32 / std::numbers::pi), 2 * layer_mm);
    }
}

TEST(StrengthAnkle, a_round_post_bends_by_four_thirds_of_the_book) {
  const double radius = 3;
  const Place worst = ankles(test::cylinder({}, radius, 100, 128)).front();
  const double exact = push_n * (100 - worst.at_mm.z) * 4 / (std::numbers::pi * std::pow(radius, 3));
  EXPECT_NEAR(worst.measured, exact, 0.01 * exact);
  EXPECT_NEAR(worst.at_mm.z, radius, 0.2);
}

TEST(StrengthAnkle, a_tube_is_as_stiff_as_its_walls) {
  const TriangleMesh tube = test::ring({{4, 0}, {6, 0}, {6, 90}, {4, 90}}, 128);
  const Place worst = ankles(tube).front();
  const double inertia = std::numbers::pi / 4 * (std::pow(6, 4) - std::pow(4, 4));
  EXPECT_NEAR(worst.measured, push_n * (90 - worst.at_mm.z) * 6 / inertia, 0.01 * worst.measured);
}

TEST(StrengthAnkle, weight_presses_evenly_and_bends_where_it_leans) {
  const double density = 1000, lean = 20, width = 10, depth = 12, height = 60;
  const Place worst = ankles(test::leaning_prism(width, depth, height, lean), density).front();
  const double above = height - worst.at_mm.z, weight = density * 1e-3 * newton_per_g * width * depth * above;
  const double even = weight / (width * depth), across = width / 2 / (depth * std::pow(width, 3) / 12);
  const double along = depth / 2 / (width * std::pow(depth, 3) / 12);
  const double exact = push_n * above * std::hypot(across, along) + even + weight * lean * above / height / 2 * across;
  EXPECT_NEAR(worst.measured, exact, 0.01 * exact);
}

TEST(StrengthAnkle, two_percent_around_the_limit_shows) {
  for (const double factor : {0.98, 1.02}) {
    const double radius = 3, height = radius + factor * 16.5 * std::numbers::pi * std::pow(radius, 3) / 4 / push_n;
    for (const double turn : {0.0, 0.7}) {
      const TriangleMesh post = transformed(test::cylinder({}, radius, height, 128), test::rotation({0, 0, 1}, turn));
      EXPECT_EQ(ankles(post).front().measured > 16.5, factor > 1);
    }
  }
}

TEST(StrengthAnkle, the_neck_between_two_balls_is_the_place) {
  const Place worst = ankles(test::dumbbell({{15, 15}, {10, 45}}, 1.5, 64), 1.2).front();
  EXPECT_GT(worst.at_mm.z, 29);
  EXPECT_LT(worst.at_mm.z, 36);
  EXPECT_LT(worst.box_mm.size().x, 6.1);
}

TEST(StrengthAnkle, legs_share_a_load_as_one_beam) {
  const TriangleMesh frame = test::strip({{0, 0}, {0, 60}, {30, 60}, {30, 0}}, {{4, 0}, {4, 56}, {26, 56}, {26, 0}}, 8);
  const Place worst = ankles(frame).front();
  const double xx = 8 * (std::pow(30, 3) - std::pow(22, 3)) / 12, yy = 8 * std::pow(8, 3) / 12;
  const double exact = push_n * (60 - worst.at_mm.z) * std::hypot(15 / xx, 4 / yy);
  EXPECT_NEAR(worst.measured, exact, 0.002 * exact);
}

TEST(StrengthAnkle, an_arm_that_hangs_carries_nothing_but_weighs) {
  const auto hook = [](double tip) {
    return test::strip({{0, 0}, {0, 60}, {30, 60}, {30, tip}}, {{6, 0}, {6, 54}, {24, 54}, {24, tip}}, 8);
  };
  const double density = 2000, newton_per_mm3 = density * 1e-3 * newton_per_g;
  const Place worst = ankles(hook(20), density).front();
  ASSERT_LT(worst.at_mm.z, 20);
  const double post = 6 * 8 * (60 - worst.at_mm.z), bar = 18 * 6 * 8, arm = 6 * 8 * 40;
  const double weight = newton_per_mm3 * (post + bar + arm), bend = newton_per_mm3 * (bar * 12 + arm * 24);
  const double xx = 8 * 216 / 12.0, yy = 6 * 512 / 12.0;
  const double exact = push_n * (60 - worst.at_mm.z) * std::hypot(3 / xx, 4 / yy) + weight / 48 + bend * 3 / xx;
  EXPECT_NEAR(worst.measured, exact, 0.01 * exact);
  EXPECT_LT(worst.box_mm.size().x, 6.01);
}

TEST(StrengthAnkle, sound_shapes_bear_a_push) {
  for (const TriangleMesh& mesh :
       {test::box({}, {20, 20, 20}), test::sphere({0, 0, 20}, 20, 4), test::cone({}, 12, 40, 64),
        test::star_prism(16, 20, 16, 10), test::torus({0, 0, 6}, 20, 6, 64, 32), test::box({}, {60, 60, 2}),
        test::with_void(test::sphere({}, 20, 4), test::sphere({}, 18, 4))}) {
    const std::vector<Place> found = ankles(mesh, 1.24);
    EXPECT_TRUE(found.empty() || found.front().measured < 16.5)
        << found.front().measured << " at z " << found.front().at_mm.z;
  }
}

}  // namespace
}  // namespace aplomb
