#include "aplomb/printability/void_island.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/prints.h"

namespace aplomb {
namespace {

const TriangleMesh outside = test::box({-20, -20, 0}, {20, 20, 40});

std::vector<Place> islands(const TriangleMesh& mesh, Process process, double layer_mm = 0.2) {
  const test::Print print = test::print_of(mesh, layer_mm);
  return measure_void_island(print.printed, print.slices, Rules(process)).value();
}

double disc_mm2(double radius_mm) { return 32 * radius_mm * radius_mm * std::sin(2 * std::numbers::pi / 64); }

TEST(VoidIsland, a_pendant_starts_in_mid_air_where_its_lowest_slice_is) {
  const TriangleMesh inner = test::lathe({{0, 5}, {10, 5}, {10, 25}, {3, 25}, {3, 15}, {0, 15}}, 64);
  for (const Process process : {Process::fdm, Process::sla})
    for (const double turn : {0.0, 1.1})
      for (const double layer_mm : {0.1, 0.2}) {
        const TriangleMesh mesh = transformed(test::with_void(outside, inner), test::rotation({0, 0, 1}, turn));
        const std::vector<Place> found = islands(mesh, process, layer_mm);
        ASSERT_EQ(found.size(), 1);
        EXPECT_NEAR(found.front().measured, disc_mm2(3), 1e-3);
        EXPECT_NEAR(found.front().at_mm.z, 15, layer_mm);
      }
}

TEST(VoidIsland, resin_asks_for_a_quarter_of_a_part_to_be_held) {
  const auto stepped = [](double share) {
    const double stub = 4 * std::sqrt(share);
    return test::with_void(
        outside, test::lathe({{0, 5}, {10, 5}, {10, 25}, {4, 25}, {4, 20}, {stub, 20}, {stub, 15}, {0, 15}}, 64));
  };
  EXPECT_EQ(islands(stepped(0.245), Process::sla).size(), 2);
  EXPECT_EQ(islands(stepped(0.255), Process::sla).size(), 1);
  EXPECT_EQ(islands(stepped(0.245), Process::fdm).size(), 1);
  EXPECT_NEAR(islands(stepped(0.245), Process::fdm).front().measured, disc_mm2(4), 1e-3);
}

TEST(VoidIsland, a_sharp_tip_counts_with_what_it_grows_to_and_a_bump_does_not_count) {
  const auto pendant = [](double radius, double tip) {
    return test::with_void(outside, test::lathe({{0, 5}, {10, 5}, {10, 25}, {radius, 25}, {0, tip}}, 64));
  };
  const std::vector<Place> spike = islands(pendant(3, 15), Process::fdm);
  ASSERT_EQ(spike.size(), 1);
  EXPECT_NEAR(spike.front().measured, disc_mm2(3), 0.05 * disc_mm2(3));
  EXPECT_NEAR(spike.front().at_mm.z, 15, 0.3);
  EXPECT_TRUE(islands(pendant(0.15, 24.3), Process::fdm).empty());
}

TEST(VoidIsland, a_body_that_floats_in_a_void_is_one) {
  const TriangleMesh globe = test::with_void(outside, test::box({-10, -10, 5}, {10, 10, 35}));
  ASSERT_EQ(islands(joined(globe, test::sphere({0, 0, 20}, 4, 3)), Process::fdm).size(), 1);
}

TEST(VoidIsland, what_stands_on_a_floor_or_on_the_plate_is_none) {
  const TriangleMesh pillar = test::lathe({{0, 15}, {3, 15}, {3, 5}, {10, 5}, {10, 25}, {0, 25}}, 64);
  for (const Process process : {Process::fdm, Process::sla}) {
    EXPECT_TRUE(islands(test::with_void(outside, pillar), process).empty());
    EXPECT_TRUE(islands(test::with_void(outside, test::sphere({0, 0, 20}, 15, 4)), process).empty());
    EXPECT_TRUE(islands(joined(outside, test::box({30, 0, 0}, {40, 10, 10})), process).empty());
  }
}

TEST(VoidIsland, outside_of_voids_it_is_not_asked) {
  // An arm that hangs from above: its tip starts in mid-air, in the open.
  const TriangleMesh hook =
      test::strip({{0, 0}, {0, 30}, {20, 30}, {20, 15}}, {{5, 0}, {5, 25}, {15, 25}, {15, 15}}, 5);
  EXPECT_TRUE(islands(hook, Process::fdm).empty());
}

}  // namespace
}  // namespace aplomb
