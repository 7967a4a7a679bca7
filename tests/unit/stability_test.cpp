#include "aplomb/balance/stability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "aplomb/balance/hanging_rows.h"
#include "aplomb/balance/standing_rows.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

Stability stability_of(const TriangleMesh& mesh, const StandingPose& pose = {}, double density_g_per_cm3 = 1.24) {
  const Result<SupportPolygon> support = support_polygon(mesh, pose);
  EXPECT_TRUE(support.has_value());
  const Region body{moments(mesh), density_g_per_cm3};
  return measure_stability(support.value(), {&body, 1}, pose);
}

TEST(Stability, OfABoxFollowsTheClosedForm) {
  const Stability s = stability_of(test::box({0, 0, 0}, {20, 30, 50}), {.xy_error_mm = 0.5}, 1.2);
  EXPECT_NEAR(s.mass_g, 36, 1e-10);
  EXPECT_NEAR(s.volume_mm3, 30000, 1e-8);
  EXPECT_NEAR(s.margin_mm, 10, 1e-12);
  EXPECT_NEAR(s.com_height_mm, 25, 1e-12);
  EXPECT_NEAR(s.tip_rad, std::atan2(10.0, 25.0), 1e-14);
  EXPECT_NEAR(s.robust_tip_rad, std::atan2(9.5, 25.0), 1e-14);
  EXPECT_NEAR(std::abs(s.heading.x), 1, 1e-14);
  EXPECT_TRUE(s.can_stand);
}

TEST(Stability, OfAConeFrustumFollowsTheClosedForm) {
  const double r = 5, s = 2, h = 8;
  const int n = 24;
  const double com_height = h / 4 * (r * r + 2 * r * s + 3 * s * s) / (r * r + r * s + s * s);
  EXPECT_NEAR(stability_of(test::frustum({7, 8, 9}, r, s, h, n)).tip_rad, std::atan2(r * std::cos(pi / n), com_height),
              1e-12);
}

TEST(Stability, OfALyingTorusFollowsTheClosedForm) {
  const double reach = 30 + std::sqrt(2 * 5 * 0.1 - 0.01);
  EXPECT_NEAR(stability_of(test::torus({}, 30, 5, 600, 400)).tip_rad, std::atan2(reach, 5.0), 1e-4);
}

/// The lean at which a leaning prism's centroid (lean / 2) stands over its support's edge (the section at the
/// contact height, width / 2 + lean contact_height / height).
double critical_lean_mm(double width_mm, double height_mm, double contact_height_mm) {
  return width_mm / (1 - 2 * contact_height_mm / height_mm);
}

TEST(Stability, OfALeaningPrismChangesSignAtExactlyTheCriticalLean) {
  const double lean = critical_lean_mm(10, 40, 0.1);
  EXPECT_NEAR(stability_of(test::leaning_prism(10, 10, 40, lean)).tip_rad, 0, 1e-14);
  EXPECT_GT(stability_of(test::leaning_prism(10, 10, 40, lean - 1e-6)).tip_rad, 0);
  EXPECT_LT(stability_of(test::leaning_prism(10, 10, 40, lean + 1e-6)).tip_rad, 0);
}

TEST(Stability, OfALeaningPrismFallsTowardsItsLeanOverTheEdgeThere) {
  const Stability s = stability_of(test::leaning_prism(10, 12, 40, 20));
  EXPECT_NEAR(s.heading.x, 1, 1e-14);
  for (const Vec3& end : s.weak_edge_mm) EXPECT_NEAR(end.x, 5 + 20 * 0.1 / 40, 1e-12);
  EXPECT_EQ(s.topple_energy_j, 0);
  EXPECT_EQ(s.topple_push_n, 0);
}

TEST(Stability, OfALeaningPrismWithAVoidIsThatOfTheDifference) {
  const TriangleMesh outer = test::leaning_prism(10, 10, 40, 12), inner = test::box({5, -3, 25}, {9, 3, 36});
  const Stability s = stability_of(test::with_void(outer, inner));
  const double solid = 4000, hole = 4 * 6 * 11;
  const double x = (solid * 6 - hole * 7) / (solid - hole), z = (solid * 20 - hole * 30.5) / (solid - hole);
  EXPECT_NEAR(s.tip_rad, std::atan2(5 + 12 * 0.1 / 40 - x, z), 1e-12);
  EXPECT_GT(s.tip_rad, stability_of(outer).tip_rad);
}

TEST(Stability, ToppleEnergyIsTheLeastClimbOfTheCentreOfMassOverAnyEdge) {
  const Stability s = stability_of(test::leaning_prism(20, 26, 40, 6), {}, 1.1);
  double least_climb_mm = 1e9;  // rotate the centre of mass about the +x and the side edges, step by step
  for (const double margin : {10 + 6 * 0.1 / 40 - 3, 13.0, 13.0}) {
    double top_mm = 0;
    for (int step = 0; step <= 90000; ++step) {
      const double angle = step * degree / 1000;
      top_mm = std::max(top_mm, 20 * std::cos(angle) + margin * std::sin(angle));
    }
    least_climb_mm = std::min(least_climb_mm, top_mm - 20);
  }
  EXPECT_NEAR(s.topple_energy_j, s.mass_g * 1e-3 * 9.80665 * least_climb_mm * 1e-3, 1e-10);
}

TEST(Stability, TopplePushBalancesTheWeightAboutTheWeakEdge) {
  const Stability s = stability_of(test::box({0, 0, 0}, {20, 30, 50}));
  EXPECT_EQ(s.push_height_mm, 50);
  const double overturning_n_mm = s.topple_push_n * 50, righting_n_mm = s.mass_g * 1e-3 * 9.80665 * 10;
  EXPECT_NEAR(overturning_n_mm, righting_n_mm, 1e-10);
}

TEST(Stability, AgreesWithTheRowsThatCarvingMaximises) {
  const TriangleMesh meshes[] = {test::box({1, 2, 3}, {4, 7, 12}), test::leaning_prism(10, 9, 40, 15),
                                 test::sphere({1, 1, 1}, 5, 3), test::frustum({3, 1, 2}, 5, 2, 8, 31)};
  for (const Vec3 up : {Vec3{0, 0, 1}, Vec3{0, -1, 0}, normalized({1, 2, 3})})
    for (const TriangleMesh& mesh : meshes) {
      const StandingPose pose{.up = up};
      const SupportPolygon support = support_polygon(mesh, pose).value();
      const Stability s = stability_of(mesh, pose);
      const auto tip = [&](RowKind kind) {
        return std::atan(largest_t(standing_rows(support, pose, kind), moments(mesh)));
      };
      EXPECT_NEAR(tip(RowKind::nominal), s.tip_rad, 1e-12);
      EXPECT_NEAR(tip(RowKind::robust), s.robust_tip_rad, 1e-12);
    }
}

TEST(Stability, OfAPointOrALineOfContactNeverStands) {
  const TriangleMesh mesh = test::box({-5, -5, 0}, {5, 5, 10});
  const std::vector<Contact> line{{{-4, 0, 0}, 0}, {{4, 0, 0}, 0}};
  const Stability balanced = stability_of(mesh, {.contacts = line});
  EXPECT_FALSE(balanced.can_stand);
  EXPECT_NEAR(balanced.tip_rad, 0, 1e-15);
  const Stability falling = stability_of(mesh, {.contacts = {{{-4, 0, 0}, 0}}});
  EXPECT_FALSE(falling.can_stand);
  EXPECT_NEAR(falling.tip_rad, std::atan2(-4.0, 5.0), 1e-14);
}

TEST(Stability, UniformDensityErrorMovesNothing) {
  const TriangleMesh mesh = test::leaning_prism(10, 9, 40, 3);
  const StandingPose pose{.xy_error_mm = 0};
  const Region body{moments(mesh), 1.24, 0.15};
  const Stability s = measure_stability(support_polygon(mesh, pose).value(), {&body, 1}, pose);
  EXPECT_NEAR(s.robust_tip_rad, s.tip_rad, 1e-14);
}

TEST(FarthestCentroid, IsTheBestOfAllExtremeDensities) {
  std::vector<Region> body;
  for (int k = 0; k < 7; ++k) {
    const Vec3 at{std::sin(5.0 * k), std::cos(3.0 * k), std::sin(2.0 * k + 1)};
    const double volume = 1 + k % 3;
    body.push_back({{volume, volume * at}, 1 + 0.1 * k, 0.02 + 0.03 * (k % 4)});
  }
  const Vec3 direction = normalized({1, -2, 0.5});
  double best = -1e9;
  for (unsigned heavy = 0; heavy < 1u << body.size(); ++heavy) {
    double mass = 0, first = 0;
    for (std::size_t k = 0; k < body.size(); ++k) {
      const double sign = heavy >> k & 1 ? 1 : -1;
      const double density = body[k].density_g_per_cm3 * (1 + sign * body[k].density_error_ratio);
      mass += density * body[k].moments.volume_mm3;
      first += density * dot(direction, body[k].moments.first_mm4);
    }
    best = std::max(best, first / mass);
  }
  EXPECT_NEAR(farthest_centroid_mm(body, direction), best, 1e-14);
}

TEST(ContactVariants, ShowHowATouchingSliverGrowsWithTheContactHeight) {
  const TriangleMesh ball = test::sphere({}, 20, 6);
  const Region body{moments(ball), 1.24};
  const auto variants = contact_variants(ball, {&body, 1}, {.contact_height_mm = 0.25});
  ASSERT_TRUE(variants);
  for (const ContactVariant& v : *variants) {
    const double tau = v.contact_height_mm;
    EXPECT_NEAR(std::tan(v.tip_rad) * 20, std::sqrt(40 * tau - tau * tau), 0.05);
  }
  EXPECT_EQ((*variants)[2].contact_height_mm, 1.0);
}

TEST(HangingRows, FromOnePointGiveTheTiltBetweenThreadAndCentreOfMass) {
  const Vec3 up = normalized({1, 2, 2}), nail{3, 4, 5};
  const PlateFrame frame = plate_frame(up, 0);
  const Vec3 hanging = nail - 10 * up + 2 * frame.x_axis;
  const Result<BalanceProblem> rows = hanging_rows(std::span(&nail, 1), up);
  ASSERT_TRUE(rows);
  EXPECT_NEAR(largest_t(*rows, Moments{7, 7.0 * hanging}), -0.2, 1e-12);
  const Vec3 between = nail - 10 * up + 2 * frame.direction({std::cos(pi / 16), std::sin(pi / 16)});
  EXPECT_NEAR(largest_t(*rows, Moments{7, 7.0 * between}), -0.2 * std::cos(pi / 16), 1e-12);
}

TEST(HangingRows, FromTwoPointsGiveTheTiltAcrossAndKeepTheCentreOfMassBetween) {
  const Vec3 nails[] = {{0, 0, 10}, {8, 0, 12}};
  const Result<BalanceProblem> rows = hanging_rows(nails, {0, 0, 1});
  ASSERT_TRUE(rows);
  EXPECT_NEAR(largest_t(*rows, Moments{1, {4, 1.5, 6}}), -1.5 / 5,
              1e-12);  // the axis is 11 high over the middle
  EXPECT_EQ(largest_t(*rows, Moments{1, {9, 0, 6}}), -std::numeric_limits<double>::infinity());
}

TEST(HangingRows, RefuseWhatIsNotOneOrTwoPointsSideBySide) {
  const Vec3 points[] = {{0, 0, 0}, {0, 0, 5}, {1, 0, 0}};
  EXPECT_FALSE(hanging_rows(std::span<const Vec3>(), {0, 0, 1}));
  EXPECT_FALSE(hanging_rows(std::span(points, 2), {0, 0, 1}));
  EXPECT_FALSE(hanging_rows(std::span(points, 3), {0, 0, 1}));
}

}  // namespace
}  // namespace aplomb
