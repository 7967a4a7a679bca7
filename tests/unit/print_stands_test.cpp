#include "aplomb/printability/print_stands.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/prints.h"

namespace aplomb {
namespace {

const std::vector<Vec2> square{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};

std::vector<Place> shares(const TriangleMesh& mesh, double layer_mm = 0.2, double turn_rad = 0) {
  const test::Print print = test::print_of(transformed(mesh, test::rotation({0, 0, 1}, turn_rad)), layer_mm);
  return measure_print_stands(print.printed, print.slices, Rules(Process::fdm)).value();
}

TEST(PrintStands, a_leaning_prism_loses_half_its_lean_of_the_support) {
  for (const double layer_mm : {0.1, 0.2})
    for (const double turn : {0.0, 0.9, 3.0})
      for (const double lean : {4.0, 8.0, 9.8, 10.2, 14.0}) {
        const std::vector<Place> found = shares(test::leaning_prism(10, 12, 30, lean), layer_mm, turn);
        ASSERT_EQ(found.size(), 1);
        // The contact is cut half a layer up, where the prism has leaned a little.
        EXPECT_NEAR(found.front().measured, 1 - lean / 2 / 5, 0.01);
        EXPECT_EQ(found.front().measured<0, lean> 10);
      }
}

TEST(PrintStands, what_leans_back_in_time_may_still_topple_on_the_way) {
  const TriangleMesh bow = test::tower(square, {{0, 0, 0}, {12, 0, 30}, {-12, 0, 90}});
  const std::vector<Place> found = shares(bow);
  ASSERT_EQ(found.size(), 1);
  EXPECT_LT(found.front().measured, 0);
  // c(h) = ((0..30: 6 mm) 30 + integral of 12 - 0.4 s) / h is largest at h = 30 sqrt(2).
  EXPECT_NEAR(found.front().at_mm.z, 30 * std::sqrt(2.0), 0.5);
  EXPECT_LT(found.front().box_mm.max.z, 89);
}

TEST(PrintStands, legs_that_lean_on_each_other_topple_before_they_meet) {
  const auto arch = [](double lean) {
    return test::strip({{-lean - 5, 0}, {-5, 30}, {-1, 32}, {1, 32}, {5, 30}, {lean + 5, 0}},
                       {{-lean, 0}, {-2, 28}, {-1, 29}, {1, 29}, {2, 28}, {lean, 0}}, 10);
  };
  EXPECT_GT(shares(arch(4)).front().measured, 0);
  const std::vector<Place> found = shares(arch(20));
  ASSERT_EQ(found.size(), 2);
  EXPECT_LT(found.front().measured, 0);
  EXPECT_LT(found.front().box_mm.max.z, 30);
}

TEST(PrintStands, what_hangs_while_it_is_printed_is_left_out) {
  const TriangleMesh hook =
      test::strip({{0, 0}, {0, 30}, {12, 30}, {12, 15}}, {{10, 0}, {10, 28}, {11, 28}, {11, 15}}, 10);
  const std::vector<Place> found = shares(hook);
  ASSERT_EQ(found.size(), 1);
  EXPECT_GT(found.front().measured, 0.5);
}

TEST(PrintStands, upright_shapes_keep_all_of_it) {
  EXPECT_NEAR(shares(test::tower(square, {{0, 0, 0}, {0, 0, 40}})).front().measured, 1, 1e-4);
  EXPECT_NEAR(shares(test::sphere({0, 0, 20}, 20, 4)).front().measured, 1, 0.05);
  EXPECT_NEAR(shares(test::cone({}, 10, 40, 64)).front().measured, 1, 1e-3);
  EXPECT_NEAR(shares(test::star_prism(12, 10, 8, 20)).front().measured, 1, 1e-3);
}

TEST(PrintStands, moving_and_scaling_change_nothing) {
  const TriangleMesh figure = test::leaning_prism(10, 12, 30, 6);
  const double share = shares(figure).front().measured;
  EXPECT_NEAR(shares(transformed(figure, test::translation({50, -70, 13}))).front().measured, share, 1e-4);
  EXPECT_NEAR(shares(transformed(figure, test::scaling(2)), 0.4).front().measured, share, 1e-4);
}

}  // namespace
}  // namespace aplomb
