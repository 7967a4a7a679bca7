#include "aplomb/printability/void_bridge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/prints.h"

namespace aplomb {
namespace {

const TriangleMesh outside = test::box({-40, -40, 0}, {40, 40, 60});

std::vector<Place> bridges(const TriangleMesh& inner, double layer_mm = 0.2, double turn_rad = 0) {
  const TriangleMesh mesh = transformed(test::with_void(outside, inner), test::rotation({0, 0, 1}, turn_rad));
  const test::Print print = test::print_of(mesh, layer_mm);
  return measure_void_bridge(print.printed, print.slices, Rules(Process::fdm)).value();
}

TriangleMesh slot(double width_mm) { return test::box({-width_mm / 2, -15, 10}, {width_mm / 2, 15, 30}); }

TEST(VoidBridge, a_slot_spans_its_width_and_a_disc_its_diameter) {
  for (const double layer_mm : {0.1, 0.2, 0.3}) {
    EXPECT_NEAR(bridges(slot(9), layer_mm).front().measured, 9, 3e-3) << layer_mm;
    const TriangleMesh disc = test::cylinder({0, 0, 10}, 6, 20, 96);
    EXPECT_NEAR(bridges(disc, layer_mm).front().measured, 12 * std::cos(std::numbers::pi / 96), 3e-3) << layer_mm;
  }
}

TEST(VoidBridge, two_percent_beyond_a_limit_shows_whichever_way_the_void_is_turned) {
  for (const double limit : {10.0, 16.0})
    for (const double turn : {0.0, 0.4, std::numbers::pi / 4, 2.0}) {
      EXPECT_LT(bridges(slot(0.98 * limit), 0.2, turn).front().measured, limit);
      EXPECT_GT(bridges(slot(1.02 * limit), 0.2, turn).front().measured, limit);
      EXPECT_LT(bridges(test::cylinder({0, 0, 10}, 0.49 * limit, 20, 64), 0.2, turn).front().measured, limit);
      EXPECT_GT(bridges(test::cylinder({0, 0, 10}, 0.51 * limit, 20, 64), 0.2, turn).front().measured, limit);
    }
}

TEST(VoidBridge, a_ledge_that_ends_in_mid_air_counts_twice_its_reach) {
  const TriangleMesh ledge = test::lathe({{0, 5}, {10, 5}, {10, 15}, {3, 15}, {3, 25}, {0, 25}}, 128);
  const std::vector<Place> found = bridges(ledge);
  EXPECT_NEAR(found.front().measured, 14, 0.02);
  EXPECT_NEAR(found.front().at_mm.z, 15.1, 1e-6);
}

TEST(VoidBridge, a_roof_as_steep_as_the_limit_spans_next_to_nothing) {
  const TriangleMesh roof = test::lathe({{0, 5}, {15, 5}, {0, 5 + 15 * std::tan(47 * std::numbers::pi / 180)}}, 64);
  const std::vector<Place> found = bridges(roof);
  EXPECT_TRUE(found.empty() || found.front().measured < 1.0);
}

TEST(VoidBridge, the_top_of_a_ball_spans_what_one_layer_sees_of_it) {
  for (const double layer_mm : {0.1, 0.2}) {
    const double span = bridges(test::sphere({0, 0, 30}, 20, 5), layer_mm).front().measured;
    EXPECT_LT(span, 2 * std::sqrt(2 * 20 * layer_mm) + 0.01);
    EXPECT_GT(span, 0);
  }
}

TEST(VoidBridge, ceilings_far_apart_are_places_of_their_own_and_the_widest_comes_first) {
  TriangleMesh two = test::with_void(outside, test::box({-35, -15, 10}, {-23, 15, 30}));
  two = test::with_void(std::move(two), test::box({5, -15, 10}, {25, 15, 20}));
  const test::Print print = test::print_of(two);
  const std::vector<Place> found = measure_void_bridge(print.printed, print.slices, Rules(Process::fdm)).value();
  ASSERT_EQ(found.size(), 2);
  EXPECT_NEAR(found[0].measured, 20, 2e-3);
  EXPECT_NEAR(found[1].measured, 12, 2e-3);
  EXPECT_NEAR(found[1].box_mm.max.x - found[1].box_mm.min.x, 12, 1);
}

TEST(VoidBridge, only_filament_bridges) {
  const test::Print print = test::print_of(test::with_void(outside, slot(20)));
  for (const Process process : {Process::sla, Process::powder, Process::binder})
    EXPECT_TRUE(measure_void_bridge(print.printed, print.slices, Rules(process))->empty());
}

TEST(VoidBridge, a_solid_without_voids_has_no_ceiling) {
  const test::Print print = test::print_of(test::torus({0, 0, 10}, 20, 6, 64, 32));
  EXPECT_TRUE(measure_void_bridge(print.printed, print.slices, Rules(Process::fdm))->empty());
}

}  // namespace
}  // namespace aplomb
