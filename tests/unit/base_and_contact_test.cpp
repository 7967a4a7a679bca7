#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "aplomb/printability/bed_contact.h"
#include "aplomb/printability/void_base.h"
#include "support/prints.h"

namespace aplomb {
namespace {

std::vector<Place> bases(const TriangleMesh& mesh, Process process = Process::fdm) {
  const test::Print print = test::print_of(mesh);
  return measure_void_base(print.printed, print.slices, Rules(process)).value();
}

TEST(VoidBase, a_floor_measures_its_thickness_wherever_the_plate_is) {
  for (const double limit : {0.8, 0.5})
    for (const double factor : {0.98, 1.02})
      for (const double turn : {0.0, 0.8}) {
        const double floor = factor * limit;
        const TriangleMesh mesh =
            test::with_void(test::box({-20, -20, 7}, {20, 20, 40}), test::box({-9, -9, 7 + floor}, {9, 9, 30}));
        const std::vector<Place> found = bases(transformed(mesh, test::rotation({0, 0, 1}, turn)));
        ASSERT_EQ(found.size(), 1);
        EXPECT_NEAR(found.front().measured, floor, 1e-5);
      }
}

TEST(VoidBase, a_slanting_floor_counts_where_it_is_over_the_contact_only) {
  // A foot of radius 5 under a disc of radius 20, with a bowl-shaped void whose rim is lower than its middle.
  const TriangleMesh outer = test::lathe({{0, 0}, {5, 0}, {5, 4}, {20, 4}, {20, 30}, {0, 30}}, 64);
  const TriangleMesh inner = test::lathe({{0, 10}, {15, 7}, {15, 25}, {0, 25}}, 64);
  const std::vector<Place> found = bases(test::with_void(outer, inner));
  ASSERT_EQ(found.size(), 1);
  EXPECT_NEAR(found.front().measured, 9, 2e-3);  // at the rim of the foot
  EXPECT_NEAR(std::hypot(found.front().at_mm.x, found.front().at_mm.y), 5, 0.02);
}

TEST(VoidBase, a_void_beside_the_contact_has_no_floor) {
  const TriangleMesh outer = test::lathe({{0, 0}, {5, 0}, {5, 4}, {30, 4}, {30, 30}, {0, 30}}, 64);
  EXPECT_TRUE(bases(test::with_void(outer, test::box({12, -5, 4.5}, {20, 5, 20}))).empty());
  EXPECT_TRUE(bases(test::with_void(outer, test::box({-5, -5, 4.5}, {5, 5, 20})), Process::powder).empty());
}

TEST(VoidBase, the_thinnest_of_many_comes_first) {
  TriangleMesh mesh = test::box({0, 0, 0}, {40, 20, 20});
  for (const auto& [x, floor] : {std::pair{2.0, 0.7}, {12.0, 0.3}, {22.0, 5.0}})
    mesh = test::with_void(std::move(mesh), test::box({x, 2, floor}, {x + 8, 18, 18}));
  const std::vector<Place> found = bases(mesh);
  ASSERT_EQ(found.size(), 2);
  EXPECT_NEAR(found[0].measured, 0.3, 1e-6);
  EXPECT_NEAR(found[1].measured, 0.7, 1e-6);
}

TEST(BedContact, it_is_the_area_of_the_first_layer_and_two_percent_around_the_limit_shows) {
  for (const double factor : {0.98, 1.02})
    for (const double turn : {0.0, 0.6}) {
      const TriangleMesh post = test::box({0, 0, 3}, {5, 5 * factor, 40});
      const test::Print print = test::print_of(transformed(post, test::rotation({0, 0, 1}, turn)));
      const std::vector<Place> found = measure_bed_contact(print.slices, Rules(Process::fdm));
      ASSERT_EQ(found.size(), 1);
      EXPECT_NEAR(found.front().measured, 25 * factor, 1e-4);
      EXPECT_NEAR(bed_contact(print.slices).width_mm, 5 * std::min(1.0, factor), 1e-5);
      EXPECT_NEAR(found.front().at_mm.z, 3, 1e-9);
    }
}

TEST(BedContact, of_a_ball_it_is_what_the_middle_of_the_first_layer_cuts) {
  for (const double layer_mm : {0.1, 0.2}) {
    const test::Print print = test::print_of(test::sphere({0, 0, 20}, 20, 6), layer_mm);
    const double half = layer_mm / 2, exact = std::numbers::pi * half * (40 - half);
    EXPECT_NEAR(bed_contact(print.slices).area_mm2, exact, 0.03 * exact);
  }
}

TEST(BedContact, feet_count_together_and_their_hull_gives_the_width) {
  const TriangleMesh arch = test::strip({{0, 0}, {0, 30}, {30, 30}, {30, 0}}, {{5, 0}, {5, 25}, {25, 25}, {25, 0}}, 8);
  const BedContact contact = bed_contact(test::print_of(arch).slices);
  EXPECT_EQ(contact.parts, 2);
  EXPECT_NEAR(contact.area_mm2, 80, 1e-4);
  EXPECT_NEAR(contact.width_mm, 8, 1e-5);
  EXPECT_NEAR(contact.center_mm.x, 15, 1e-5);
}

}  // namespace
}  // namespace aplomb
