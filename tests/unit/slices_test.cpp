#include "aplomb/printability/slices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/prints.h"

namespace aplomb {
namespace {

using test::print_of;

double volume_mm3(const Slices& slices) {
  double sum = 0;
  for (const Slice& slice : slices.layers) sum += slice.moments().area_mm2 * slices.layer_mm;
  return sum;
}

TEST(PlaneMoments, of_a_rectangle_far_from_the_origin_they_are_those_of_the_book) {
  const PlaneMoments m = plane_moments({{100, 200}, {106, 200}, {106, 204}, {100, 204}});
  EXPECT_DOUBLE_EQ(m.area_mm2, 24);
  EXPECT_NEAR(m.centroid_mm().x, 103, 1e-9);
  const PlaneMoments central = m.about_centroid();
  EXPECT_NEAR(central.xx_mm4, 4 * 216 / 12.0, 1e-7);
  EXPECT_NEAR(central.yy_mm4, 6 * 64 / 12.0, 1e-7);
  EXPECT_NEAR(central.xy_mm4, 0, 1e-7);
}

TEST(PlaneMoments, of_a_triangle_the_mixed_moment_is_that_of_the_book) {
  const PlaneMoments m = plane_moments({{0, 0}, {6, 0}, {0, 4}});
  EXPECT_NEAR(m.xy_mm4, 36 * 16 / 24.0, 1e-9);
  EXPECT_NEAR(m.about_centroid().xy_mm4, -36 * 16 / 72.0, 1e-9);
  EXPECT_NEAR(plane_moments({{0, 4}, {6, 0}, {0, 0}}).xx_mm4, -m.xx_mm4, 1e-9);
}

TEST(Slices, a_box_is_the_same_rectangle_in_every_layer) {
  const Slices slices = print_of(test::box({1, 2, 3}, {11, 7, 23})).slices;
  ASSERT_EQ(slices.layers.size(), 100);
  for (const Slice& slice : slices.layers) {
    ASSERT_EQ(slice.parts.size(), 1);
    EXPECT_NEAR(slice.moments().area_mm2, 50, 1e-9);
    EXPECT_NEAR(slice.moments().centroid_mm().y, 4.5, 1e-9);
  }
}

TEST(Slices, vertices_edges_and_faces_on_a_cutting_plane_leave_loops_closed) {
  // Layers of 1 mm are cut at 0.5, 1.5, 2.5, 3.5; two level faces lie there, and count as above.
  const TriangleMesh steps = test::lathe({{0, 0}, {9, 0}, {9, 0.5}, {5, 0.5}, {5, 2.5}, {7, 2.5}, {0, 4.3}}, 24);
  const Slices slices = print_of(steps, 1).slices;
  ASSERT_EQ(slices.layers.size(), 4);
  const double disc = 12 * std::sin(2 * std::numbers::pi / 24);  // of radius 1
  for (const auto& [layer, radius] : {std::pair{0, 9.0}, {1, 5.0}, {2, 5.0}, {3, 7 * 0.8 / 1.8}}) {
    ASSERT_EQ(slices.layers[layer].parts.size(), 1) << layer;
    EXPECT_NEAR(slices.layers[layer].moments().area_mm2, disc * radius * radius, 1e-5) << layer;
  }
}

TEST(Slices, their_volume_nears_that_of_the_solid_with_the_square_of_the_layer) {
  const TriangleMesh ball = test::with_void(test::sphere({}, 20, 4), test::sphere({3, 0, 2}, 10, 3));
  const double exact = test::solid_of(ball).moments().volume_mm3;
  EXPECT_NEAR(volume_mm3(print_of(ball, 0.2).slices), exact, 2e-5 * exact);
  EXPECT_NEAR(volume_mm3(print_of(ball, 0.1).slices), exact, 8e-6 * exact);
}

TEST(Slices, loops_know_the_void_they_bound_and_parts_their_holes) {
  const TriangleMesh hollow =
      test::with_void(test::with_void(test::box({0, 0, 0}, {40, 20, 20}), test::box({2, 2, 2}, {18, 18, 18})),
                      test::box({22, 2, 4}, {38, 18, 18}));
  const test::Print print = print_of(joined(hollow, test::box({8, 8, 8}, {12, 12, 12})));  // one floats in a void
  const Slice& slice = print.slices.layers[50];
  ASSERT_EQ(slice.parts.size(), 2);
  EXPECT_EQ(slice.parts[0].loops.size(), 3);
  EXPECT_NEAR(slice.parts[0].moments.area_mm2, 800 - 2 * 256, 1e-9);
  EXPECT_NEAR(slice.parts[1].moments.area_mm2, 16, 1e-9);
  EXPECT_NEAR(area_mm2(slice.void_space()), 2 * 256 - 16, 1e-9);
  for (const SliceLoop& loop : slice.loops) EXPECT_EQ(loop.void_index.has_value(), !loop.is_outline());
}

TEST(Slices, turning_about_the_vertical_turns_them) {
  const TriangleMesh figure = test::dumbbell({{10, 10}, {6, 28}}, 3, 40);
  const Slices straight = print_of(figure).slices;
  const Slices turned = print_of(transformed(figure, test::rotation({0, 0, 1}, 0.7))).slices;
  ASSERT_EQ(straight.layers.size(), turned.layers.size());
  for (std::size_t layer = 0; layer < straight.layers.size(); ++layer)
    EXPECT_NEAR(straight.layers[layer].moments().area_mm2, turned.layers[layer].moments().area_mm2, 1e-3);
}

TEST(Slices, of_too_many_layers_they_say_so) {
  const Result<Slices> slices = cut_slices(printed_solid(test::solid_of(test::box({}, {1, 1, 1000}))), 1e-4);
  ASSERT_FALSE(slices);
  EXPECT_EQ(slices.error().code, ErrorCode::over_budget);
}

TEST(Slices, a_job_stops_them) {
  test::CancelAt cancel(2);
  const Result<Slices> slices = cut_slices(printed_solid(test::solid_of(test::sphere({}, 20, 3))), 0.1, cancel.job());
  ASSERT_FALSE(slices);
  EXPECT_EQ(slices.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace aplomb
