#include "aplomb/printability/walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

Rules rules_with(std::string_view id, double limit) {
  Rules rules(Process::fdm);
  EXPECT_TRUE(rules.set(id, limit));
  return rules;
}

std::vector<Affine3> turns() {
  return {test::rotation({0, 0, 1}, 0), test::rotation({1, 2, 3}, 1), test::rotation({-1, 0.3, 0.2}, 2.2)};
}

PrintedSolid printed(const TriangleMesh& mesh, const Affine3& turn = {}) {
  return printed_solid(test::solid_of(transformed(mesh, turn)));
}

/// What is thinner than the limit, worst first.
std::vector<Place> thin(const PrintedSolid& solid, double limit) {
  std::vector<Place> places = *wall_thin(solid, rules_with("wall.thin", limit));
  std::erase_if(places, [&](const Place& place) { return place.measured >= limit; });
  return places;
}

/// A prism whose section is a triangle with the given angle at the origin.
TriangleMesh wedge(double angle_rad, double length) {
  return test::prism({{0, 0}, {length, -length * std::tan(angle_rad / 2)}, {length, length * std::tan(angle_rad / 2)}},
                     0, {0, 0, 10});
}

TEST(WallThin, a_plate_is_found_below_the_limit_and_not_above_however_it_lies) {
  for (const Affine3& turn : turns())
    for (const double limit : {0.5, 0.8, 2.0}) {
      const auto plate = [&](double share) { return printed(test::box({0, 0, 0}, {20, 15, share * limit}), turn); };
      const auto found = thin(plate(0.98), limit);
      ASSERT_EQ(found.size(), 1U);
      EXPECT_NEAR(found.front().measured, 0.98 * limit, 1e-4);
      EXPECT_GT(found.front().box_mm.diagonal(), 20);
      EXPECT_TRUE(thin(plate(1.02), limit).empty());
      EXPECT_NEAR(wall_thin(plate(1.02), rules_with("wall.thin", limit))->front().measured, 1.02 * limit, 1e-4);
    }
}

TEST(WallThin, a_rod_is_found_below_the_limit_and_not_above_whatever_its_facets) {
  for (const Affine3& turn : turns())
    for (const int facets : {6, 32, 96}) {
      const double inner = std::cos(std::numbers::pi / facets);  // of the flats, for a corner radius of 1
      const auto rod = [&](double thickness) {
        return printed(test::cylinder({0, 0, 0}, 0.5 * thickness / inner, 30, facets), turn);
      };
      EXPECT_EQ(thin(rod(0.98 * 0.8), 0.8).size(), 1U) << facets;
      EXPECT_TRUE(thin(rod(1.02 * 0.8), 0.8).empty()) << facets;
    }
}

TEST(WallThin, the_wall_of_a_cup_is_found_below_the_limit_and_not_above) {
  for (const Affine3& turn : turns()) {
    const auto cup = [&](double wall) {
      return printed(test::lathe({{0, 0}, {10, 0}, {10, 30}, {10 - wall, 30}, {10 - wall, 3}, {0, 3}}, 96), turn);
    };
    EXPECT_EQ(thin(cup(0.98 * 0.8), 0.8).size(), 1U);
    EXPECT_TRUE(thin(cup(1.025 * 0.8), 0.8).empty());  // facets take 0.05 % of the radius, here 0.6 % of the wall
  }
}

TEST(WallThin, a_wedge_is_thin_only_where_it_is_sharper_than_twenty_degrees) {
  for (const Affine3& turn : turns()) {
    const double degree = std::numbers::pi / 180;
    EXPECT_TRUE(thin(printed(wedge(22 * degree, 20), turn), 0.8).empty());
    const auto found = thin(printed(wedge(18 * degree, 20), turn), 0.8);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(norm(found.front().box_mm.size()), std::hypot(10, 0.8 / (2 * std::tan(9 * degree))), 3);
  }
}

TEST(WallThin, sharp_edges_and_corners_are_not_thin) {
  const std::vector<TriangleMesh> sound{test::box({0, 0, 0}, {20, 20, 20}),
                                        test::sphere({0, 0, 20}, 20, 4),
                                        test::cone({0, 0, 0}, 10, 15, 64),
                                        test::torus({0, 0, 5}, 20, 4, 96, 32),
                                        test::star_prism(5, 30, 12, 10),
                                        test::star_prism(24, 20, 17, 6),
                                        test::tetrahedron({0, 0, 0}, {20, 0, 0}, {0, 20, 0}, {0, 0, 20}),
                                        test::leaning_prism(20, 20, 30, 40)};
  for (const TriangleMesh& mesh : sound)
    for (const Affine3& turn : turns())
      for (const double limit : {0.5, 2.0}) EXPECT_TRUE(thin(printed(mesh, turn), limit).empty());
}

TEST(WallThin, a_spike_counts_only_where_it_is_more_than_a_sliver) {
  const auto spiked = [](double radius, double height) {
    return printed(test::lathe({{0, 0}, {10, 0}, {10, 10}, {radius, 10}, {0, 10 + height}}, 24));
  };
  EXPECT_TRUE(thin(spiked(0.15, 2), 0.8).empty());
  EXPECT_EQ(thin(spiked(0.35, 8), 0.8).size(), 1U);
}

TEST(WallThin, a_gap_beside_a_thick_block_does_not_make_it_thin) {
  // Two blocks 0.05 apart; the second one's foot lies just below the first one's top.
  const auto solid = printed(joined(test::box({0, 0, 0}, {10, 10, 10}), test::box({10.05, 0, 9.5}, {20, 10, 20})));
  EXPECT_TRUE(thin(solid, 0.8).empty());
}

TEST(WallThin, two_thin_plates_apart_are_two_places_worst_first) {
  const auto solid = printed(joined(test::box({0, 0, 0}, {20, 20, 0.6}), test::box({0, 0, 10}, {20, 20, 10.4})));
  const auto found = thin(solid, 0.8);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].measured, 0.4, 1e-4);
  EXPECT_NEAR(found[0].at_mm.z, 10.2, 1e-4);
  EXPECT_NEAR(found[1].measured, 0.6, 1e-4);
}

TEST(WallThin, what_passes_is_measured_too) {
  const auto places = wall_thin(printed(test::box({0, 0, 0}, {50, 40, 30})), Rules(Process::fdm));
  ASSERT_EQ(places->size(), 1U);
  EXPECT_NEAR(places->front().measured, 30, 1e-4);
}

TEST(WallVoidOuter, the_verdict_flips_at_the_limit_and_names_the_place) {
  for (const Affine3& turn : turns()) {
    const auto shell = [&](double wall) {
      return printed(test::with_void(test::box({0, 0, 0}, {40, 40, 40}), test::box({5, 5, 5}, {35, 40 - wall, 35})),
                     turn);
    };
    const Rules rules = rules_with("wall.void_outer", 0.8);
    const auto thin_shell = wall_void_outer(shell(0.98 * 0.8), rules);
    ASSERT_EQ(thin_shell->size(), 1U);
    EXPECT_NEAR(thin_shell->front().measured, 0.98 * 0.8, 2e-4);
    const Vec3 at = transposed(turn.linear) * thin_shell->front().at_mm;
    EXPECT_NEAR(at.y, 40 - 0.49 * 0.8, 1e-3);
    const auto sound = wall_void_outer(shell(1.02 * 0.8), rules);
    ASSERT_EQ(sound->size(), 1U);
    EXPECT_NEAR(sound->front().measured, 1.02 * 0.8, 2e-4);
  }
}

TEST(WallVoidOuter, each_thin_spot_is_a_place_of_its_own) {
  const auto shell =
      printed(test::with_void(test::box({0, 0, 0}, {40, 40, 40}), test::box({0.5, 5, 5}, {39.4, 35, 35})));
  const auto places = wall_void_outer(shell, rules_with("wall.void_outer", 0.8));
  ASSERT_EQ(places->size(), 2U);
  EXPECT_NEAR(places->front().measured, 0.5, 1e-4);
  EXPECT_NEAR(places->back().measured, 0.6, 1e-4);
  EXPECT_GT(places->back().at_mm.x, 39);
}

TEST(WallVoidVoid, the_verdict_flips_at_the_limit) {
  for (const Affine3& turn : turns())
    for (const double share : {0.98, 1.02}) {
      TriangleMesh mesh = test::with_void(test::box({-30, -30, -30}, {30, 30, 30}), test::sphere({-10, 0, 0}, 8, 4));
      mesh = test::with_void(mesh, test::sphere({6 + share * 0.8, 0, 0}, 8, 4));
      const auto places = wall_void_void(printed(mesh, turn), rules_with("wall.void_void", 0.8));
      ASSERT_EQ(places->size(), 1U);
      EXPECT_EQ(places->front().measured < 0.8, share < 1);
    }
}

TEST(WallChecks, a_solid_without_voids_has_no_wall_to_measure) {
  const auto solid = printed(test::box({0, 0, 0}, {9, 9, 9}));
  EXPECT_TRUE(wall_void_outer(solid, Rules(Process::sla))->empty());
  EXPECT_TRUE(wall_void_void(solid, Rules(Process::sla))->empty());
}

TEST(WallChecks, can_be_cancelled) {
  const auto solid = printed(test::with_void(test::box({0, 0, 0}, {9, 9, 9}), test::box({3, 3, 3}, {6, 6, 6})));
  for (const auto check : {wall_thin, wall_void_outer}) {
    const auto stopped = check(solid, Rules(Process::sla), test::CancelAt(1).job());
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace aplomb
