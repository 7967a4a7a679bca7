#include "aplomb/printability/cavities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "aplomb/core/threads.h"
#include "aplomb/printability/detail/passage.h"
#include "aplomb/printability/escape.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

constexpr int segments = 48;
const double flats = 1 / std::cos(std::numbers::pi / segments);  // corner radius of a polygon round a unit circle

/// A closed profile (radius, height), counter-clockwise, turned about the z axis: a ring.
TriangleMesh ring(const std::vector<Vec2>& profile) {
  TriangleMesh mesh;
  for (const Vec2& p : profile)
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments;
      mesh.vertices.push_back({p.x * std::cos(angle), p.x * std::sin(angle), p.y});
    }
  const auto n = static_cast<std::uint32_t>(segments), rings = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t low = n * r, high = n * ((r + 1) % rings), next = (i + 1) % n;
      mesh.triangles.push_back({low + i, low + next, high + next});
      mesh.triangles.push_back({low + i, high + next, high + i});
    }
  return mesh;
}

/// Upward along a circle about (0, height) from radius `from` below it to radius `to` above.
std::vector<Vec2> arc(double radius, double height, double from, double to) {
  const double begin = std::asin(from / radius), end = std::numbers::pi - std::asin(to / radius);
  std::vector<Vec2> points;
  for (int i = 0; i <= segments; ++i) {
    const double angle = begin + (end - begin) * i / segments;
    points.push_back({(i == 0 && from == 0) || (i == segments && to == 0) ? 0 : radius * std::sin(angle),
                      height - radius * std::cos(angle)});
  }
  return points;
}

/// A ball with walls of `wall`, a round bore of radius `top` above and one of radius `bottom` below; no bore where 0.
TriangleMesh hollow_ball(double inner, double wall, double top, double bottom) {
  std::vector<Vec2> profile = arc(inner + wall, 0, flats * bottom, flats * top);
  const std::vector<Vec2> inside = arc(inner, 0, flats * bottom, flats * top);
  profile.insert(profile.end(), inside.rbegin(), inside.rend());
  return bottom > 0 ? ring(profile) : test::lathe(profile, segments);
}

/// A cylinder that holds two balls' worth of empty space, joined by a neck; a bore leads out of the upper one.
TriangleMesh two_chambers(double neck, double bore) {
  std::vector<Vec2> profile{{0, -15}, {15, -15}, {15, 41}, {flats * bore, 41}};
  const std::vector<Vec2> lower = arc(10, 0, 0, flats * neck), upper = arc(10, 26, flats * neck, flats * bore);
  profile.insert(profile.end(), upper.rbegin(), upper.rend());
  profile.insert(profile.end(), lower.rbegin(), lower.rend());
  return test::lathe(profile, segments);
}

std::vector<Affine3> turns() {
  return {test::rotation({0, 0, 1}, 0), test::rotation({1, 2, 3}, 1), test::rotation({-1, 0.3, 0.2}, 2.2)};
}

PrintedSolid printed(const TriangleMesh& mesh, const Affine3& turn = {}) {
  return printed_solid(test::solid_of(transformed(mesh, turn)));
}

std::vector<Cavity> cavities(const TriangleMesh& mesh, double hole, const Affine3& turn = {}) {
  return find_cavities(printed(mesh, turn), hole).value();
}

TEST(Cavities, the_bottleneck_of_a_round_bore_is_its_radius_however_it_lies) {
  for (const Affine3& turn : turns())
    for (const double radius : {1.6, 1.9, 2.7, 4.0}) {
      const auto found = cavities(hollow_ball(14, 2, radius, 0), 3.5, turn);
      ASSERT_EQ(found.size(), 1U);
      ASSERT_EQ(found.front().openings.size(), 1U) << radius;
      const Opening& opening = found.front().openings.front();
      EXPECT_LE(opening.diameter_mm, 2 * radius * 1.0001);
      EXPECT_GE(opening.diameter_mm, 2 * radius * 0.988);
      const Vec3 at = transposed(turn.linear) * opening.at_mm, along = transposed(turn.linear) * opening.along;
      EXPECT_NEAR(std::hypot(at.x, at.y), 0, 0.05 * radius);
      EXPECT_GT(at.z, 12);
      EXPECT_GT(along.z, 0.9);
    }
}

TEST(Cavities, a_hole_is_one_at_two_percent_more_than_the_ball_and_none_at_two_percent_less) {
  for (const Affine3& turn : turns())
    for (const double hole : {3.5, 4.0, 5.0})
      for (const double share : {0.98, 1.02}) {
        const auto found = cavities(hollow_ball(14, 2, 0.5 * share * hole, 0), hole, turn);
        ASSERT_EQ(found.size(), 1U);
        EXPECT_EQ(found.front().is_closed(hole), share < 1);
        EXPECT_FALSE(found.front().is_shell);
      }
}

TEST(Cavities, every_opening_is_counted_with_its_own_diameter) {
  for (const Affine3& turn : turns()) {
    const auto found = cavities(hollow_ball(14, 2, 2, 2.6), 3.5, turn);
    ASSERT_EQ(found.size(), 1U);
    ASSERT_EQ(found.front().openings.size(), 2U);
    EXPECT_NEAR(found.front().openings[0].diameter_mm, 5.2, 0.06);
    EXPECT_NEAR(found.front().openings[1].diameter_mm, 4.0, 0.05);
    EXPECT_EQ(found.front().holes(3.5), 2);
    EXPECT_EQ(found.front().holes(4.5), 1);
  }
}

TEST(Cavities, of_a_ball_the_volume_depth_and_ends_are_known) {
  const Cavity cavity = cavities(hollow_ball(14, 2, 2, 0), 3.5).at(0);
  EXPECT_NEAR(cavity.volume_mm3, 4.0 / 3 * std::numbers::pi * 14 * 14 * 14, 0.05 * 11500);
  EXPECT_NEAR(cavity.clearance_mm, 14, 0.2);
  EXPECT_LT(norm(cavity.deepest_mm), 1);
  EXPECT_NEAR(cavity.lowest_mm.z, -14, 0.01);
  EXPECT_NEAR(cavity.highest_mm.z, 14, 1);  // in the bore
  EXPECT_NEAR(cavity.box_mm.size().x, 28, 0.1);
}

TEST(Cavities, a_leak_is_no_way_out) {
  for (const Affine3& turn : turns()) {
    const auto found = cavities(hollow_ball(14, 2, 0.05, 0), 3.5, turn);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found.front().is_closed(3.5));
    EXPECT_NEAR(found.front().volume_mm3, 11500, 500);
  }
}

TEST(Cavities, a_closed_shell_is_one_whatever_its_size_and_known_exactly) {
  const TriangleMesh solid =
      test::with_void(test::with_void(test::box({0, 0, 0}, {40, 40, 40}), test::box({4, 4, 4}, {24, 34, 9})),
                      test::box({30, 30, 30}, {31, 31, 31}));
  const auto found = cavities(solid, 4);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].volume_mm3, 3000, 1e-6);
  EXPECT_NEAR(found[0].clearance_mm, 2.5, 0.25);
  EXPECT_NEAR(found[1].volume_mm3, 1, 1e-6);
  for (const Cavity& cavity : found) EXPECT_TRUE(cavity.is_shell && cavity.is_closed(0.1));
}

TEST(Cavities, what_lies_loose_in_a_shell_makes_no_cavity_of_its_own) {
  const auto solid = joined(test::with_void(test::box({0, 0, 0}, {60, 60, 60}), test::box({5, 5, 5}, {55, 55, 55})),
                            test::box({20, 20, 20}, {25, 25, 25}));
  EXPECT_EQ(cavities(solid, 4).size(), 1U);
}

TEST(Cavities, chambers_are_one_cavity_where_the_ball_passes_between_them) {
  for (const Affine3& turn : turns()) {
    const auto one = cavities(two_chambers(2.04, 2.2), 4, turn);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one.front().holes(4), 1);
    auto two = cavities(two_chambers(1.96, 2.2), 4, turn);
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(std::ranges::count_if(two, [](const Cavity& c) { return c.is_closed(4); }), 1);
  }
}

TEST(Cavities, a_long_bore_as_wide_all_along_is_one_opening) {
  std::vector<Vec2> profile{{0, -14}, {14, -14}, {14, 45}, {flats * 2.1, 45}};
  const std::vector<Vec2> inside = arc(10, 0, 0, flats * 2.1);
  profile.insert(profile.end(), inside.rbegin(), inside.rend());
  for (const Affine3& turn : turns()) {
    const auto found = cavities(test::lathe(profile, segments), 4, turn);
    ASSERT_EQ(found.size(), 1U);
    ASSERT_EQ(found.front().openings.size(), 1U);
    EXPECT_NEAR(found.front().openings.front().diameter_mm, 4.2, 0.05);
  }
}

TEST(Cavities, cups_vases_rings_bores_and_notches_are_none) {
  const std::vector<TriangleMesh> open{
      test::box({0, 0, 0}, {30, 30, 30}),
      test::torus({0, 0, 0}, 20, 6, 64, 32),
      test::star_prism(24, 30, 24, 10),
      test::star_prism(5, 40, 15, 20),
      test::lathe({{0, 0}, {15, 0}, {15, 30}, {13, 30}, {13, 2}, {0, 2}}, segments),                // a cup
      test::lathe({{0, 0}, {15, 0}, {10, 30}, {8, 30}, {13, 2}, {0, 2}}, segments),                 // a vase
      test::lathe({{0, 0}, {15, 0}, {15, 30}, {flats * 2, 30}, {flats * 2, 5}, {0, 5}}, segments),  // a blind bore
      ring({{flats * 2, 0}, {15, 0}, {15, 30}, {flats * 2, 30}}),                                   // a bore
      joined(test::box({0, 0, 0}, {20, 20, 20}), test::box({24, 0, 0}, {44, 20, 20})),
      hollow_ball(14, 2, 7.5, 0)};
  for (const TriangleMesh& mesh : open)
    for (const Affine3& turn : turns()) EXPECT_TRUE(cavities(mesh, 4, turn).empty());
}

TEST(Cavities, do_not_depend_on_how_many_threads_look_for_them) {
  const TriangleMesh mesh = hollow_ball(14, 2, 2, 2.6);
  const auto look = [&](int threads) {
    const ThreadLimit limit(threads);
    return cavities(mesh, 3.5, turns()[1]).at(0);
  };
  const Cavity one = look(1), many = look(8);
  EXPECT_EQ(one.volume_mm3, many.volume_mm3);
  EXPECT_EQ(one.deepest_mm, many.deepest_mm);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(one.openings.at(n).at_mm, many.openings.at(n).at_mm);
    EXPECT_EQ(one.openings.at(n).diameter_mm, many.openings.at(n).diameter_mm);
  }
}

/// From a notch the clearance grows all the way to the outside and beyond: the bird of the public models hung there.
TEST(Cavities, a_climb_that_leads_out_of_the_solid_ends_where_it_began) {
  const TriangleMesh beam = test::box({0, 0, 0}, {40, 10, 10}), post = test::box({0, 0, 10}, {10, 10, 40});
  const detail::EmptySpace space(printed_solid(test::solid_of(joined(beam, transformed(post, {{}, {0, 0, 1}})))));
  const Vec3 notch{12, 5, 13};
  const detail::Peak peak = detail::climb(space, notch, 1);
  EXPECT_EQ(peak.at_mm, notch);
  EXPECT_EQ(peak.clearance_mm, 2);
}

TEST(Cavities, searching_can_be_cancelled_and_is_refused_where_it_would_not_end) {
  const auto solid = printed(hollow_ball(14, 2, 2, 2));
  for (const int report : {1, 2, 5}) {
    const auto stopped = find_cavities(solid, 3.5, test::CancelAt(report).job());
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  }
  EXPECT_EQ(find_cavities(solid, 0.01).error().code, ErrorCode::over_budget);
}

TEST(VoidClosed, closed_cavities_are_named_largest_first_and_none_where_all_are_open) {
  const Rules rules(Process::sla);
  const auto closed = void_closed(*find_cavities(printed(hollow_ball(14, 2, 1, 0)), rules), rules);
  ASSERT_EQ(closed.size(), 1U);
  EXPECT_EQ(closed.front().measured, 1);
  const auto open = void_closed(*find_cavities(printed(hollow_ball(14, 2, 2, 0)), rules), rules);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_EQ(open.front().measured, 0);
  EXPECT_TRUE(void_closed(*find_cavities(printed(test::box({0, 0, 0}, {9, 9, 9})), rules), rules).empty());
}

TEST(VoidHoles, are_counted_where_the_cavity_is_not_closed) {
  const Rules rules(Process::powder);
  const auto count = [&](double top, double bottom) {
    const auto places = void_holes(*find_cavities(printed(hollow_ball(14, 2, top, bottom)), rules), rules);
    return places.empty() ? -1.0 : places.front().measured;
  };
  EXPECT_EQ(count(2.1, 0), 1);
  EXPECT_EQ(count(2.1, 2.1), 2);
  EXPECT_EQ(count(2.1, 1.5), 1);
  EXPECT_EQ(count(1, 1), -1);
}

TEST(VoidHoles, one_of_5_mm_is_enough_for_powder) {
  const auto cavities_at = [](double diameter) {
    return find_cavities(printed(hollow_ball(14, 2, diameter / 2, 0)), 4);
  };
  const Rules powder(Process::powder);
  EXPECT_EQ(void_holes(*cavities_at(4.9), powder).front().measured, 1);
  EXPECT_EQ(void_holes(*cavities_at(5.1), powder).front().measured, 2);
  EXPECT_FALSE(void_hole_place(*cavities_at(4.9), powder).empty());
  EXPECT_TRUE(void_hole_place(*cavities_at(5.1), powder).empty());
  EXPECT_EQ(void_holes(*cavities_at(6), Rules(Process::sla)).front().measured, 1);
}

TEST(VoidHolePlace, resin_stays_below_the_lowest_lip) {
  const Rules rules(Process::sla);
  const auto left = [&](const TriangleMesh& mesh, double tilt) {
    const auto solid = printed(mesh, test::rotation({1, 0, 0}, tilt));
    return void_hole_place(*find_cavities(solid, rules), rules).at(0);
  };
  EXPECT_LT(left(hollow_ball(14, 2, 2, 2), 0).measured, 1);
  EXPECT_NEAR(left(hollow_ball(14, 2, 2, 2), std::numbers::pi / 2).measured, 14 - 2, 0.3);
  const Place place = left(hollow_ball(14, 2, 2, 0), std::numbers::pi);  // a hole below, no vent
  EXPECT_NEAR(place.measured, 28, 0.6);
  EXPECT_NEAR(place.at_mm.z, 14, 0.1);
}

TEST(VoidHolePlace, powder_wants_holes_half_a_diagonal_apart) {
  const Rules rules(Process::powder);
  const auto missing = [&](double bottom) {
    return void_hole_place(*find_cavities(printed(hollow_ball(14, 2, 2.1, bottom)), rules), rules).at(0).measured;
  };
  EXPECT_EQ(missing(2.1), 0);
  EXPECT_NEAR(missing(0), 14 * std::sqrt(3.0), 1);
}

}  // namespace
}  // namespace aplomb
