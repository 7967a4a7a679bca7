#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "aplomb/balance/standing.h"
#include "aplomb/balance/standing_rows.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

/// In steps of 1/1000, so that failing cases shrink to readable numbers.
double number_in(int low, int high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low * 1000, high * 1000 + 1)) / 1000.0;
}

/// A solid with a flat triangular foot, a top anywhere, and perhaps a void: it may stand or fall.
TriangleMesh random_figure() {
  const std::vector<Vec2> foot{{number_in(-20, -5), number_in(-20, -5)},
                               {number_in(5, 20), number_in(-20, -5)},
                               {number_in(-10, 10), number_in(5, 20)}};
  TriangleMesh figure = test::prism(foot, 0, {number_in(-30, 30), number_in(-30, 30), number_in(5, 60)});
  const Vec3 middle = moments(figure).centroid_mm();
  if (*rc::gen::arbitrary<bool>()) figure = test::with_void(figure, test::sphere(middle, 1, 1));
  return figure;
}

Vec3 random_direction() {
  const double angle = number_in(0, 6), height = number_in(-1, 1), radius = std::sqrt(1 - height * height);
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

Standing standing_of(const TriangleMesh& mesh, const StandingPose& pose = {}) {
  const Region body{moments(mesh), 1.24};
  return measure_standing(mesh, {&body, 1}, pose).value();
}

void assert_near(double measured, double expected, double tolerance) {
  RC_LOG() << measured << " against " << expected << " within " << tolerance << "\n";
  RC_ASSERT(std::abs(measured - expected) <= tolerance);
}

void assert_same_standing(const Standing& a, const Standing& b, double tolerance) {
  assert_near(a.stability.tip_rad, b.stability.tip_rad, tolerance);
  assert_near(a.stability.robust_tip_rad, b.stability.robust_tip_rad, tolerance);
  assert_near(a.stability.margin_mm, b.stability.margin_mm, 100 * tolerance);
  assert_near(a.support.area_mm2(), b.support.area_mm2(), 1e4 * tolerance);
  RC_ASSERT(a.pedestal.has_value() == b.pedestal.has_value());
  if (a.pedestal) assert_near(a.pedestal->radius_mm, b.pedestal->radius_mm, 1e3 * tolerance);
}

RC_GTEST_PROP(Standing, IsTheSameWhereverTheModelLies, ()) {
  const TriangleMesh figure = random_figure();
  const Vec3 by{number_in(-100000, 100000), number_in(-100000, 100000), number_in(-100000, 100000)};
  assert_same_standing(standing_of(transformed(figure, test::translation(by))), standing_of(figure), 1e-8);
}

RC_GTEST_PROP(Standing, IsTheSameHoweverTheModelIsTurnedAboutTheVertical, ()) {
  const TriangleMesh figure = random_figure();
  const Affine3 turn = test::rotation({0, 0, 1}, number_in(-3, 3));
  const Standing before = standing_of(figure), after = standing_of(transformed(figure, turn));
  assert_same_standing(after, before, 1e-9);
}

RC_GTEST_PROP(Standing, IsTheSameInEveryPoseThatTurnsWithTheModel, ()) {
  const TriangleMesh figure = random_figure();
  const Affine3 turn = test::rotation(random_direction(), number_in(-3, 3));
  const StandingPose pose{.up = normalized(turn.linear * Vec3{0, 0, 1})};
  assert_same_standing(standing_of(transformed(figure, turn), pose), standing_of(figure), 1e-9);
}

RC_GTEST_PROP(Standing, KeepsItsAnglesUnderScaling, ()) {
  const TriangleMesh figure = random_figure();
  const double factor = number_in(1, 50) / 10;
  const StandingPose pose{.contact_height_mm = 0.1 * factor, .xy_error_mm = 0.2 * factor};
  const Stability small = standing_of(figure).stability,
                  large = standing_of(transformed(figure, test::scaling(factor)), pose).stability;
  assert_near(large.tip_rad, small.tip_rad, 1e-10);
  assert_near(large.robust_tip_rad, small.robust_tip_rad, 1e-10);
  assert_near(large.margin_mm, factor * small.margin_mm, 1e-8);
  assert_near(large.topple_energy_j, std::pow(factor, 4) * small.topple_energy_j, 1e-7 * std::pow(factor, 4));
  assert_near(large.topple_push_n, std::pow(factor, 3) * small.topple_push_n, 1e-7 * std::pow(factor, 3));
}

RC_GTEST_PROP(Standing, IsWhatTheRowsOfThePoseSay, ()) {
  const TriangleMesh figure = random_figure();
  const StandingPose pose{.up = random_direction()};
  const Standing standing = standing_of(figure, pose);
  RC_PRE(!standing.support.degenerate());
  const double t = largest_t(standing_rows(standing.support, pose, RowKind::nominal), moments(figure));
  assert_near(std::atan(t), standing.stability.tip_rad, 1e-12);
}

RC_GTEST_PROP(Standing, HoldsExactlyUntilThePlateTiltsByTheTipAngleTowardsTheWeakEdge, ()) {
  const Standing standing = standing_of(random_figure());
  const Stability& s = standing.stability;
  RC_PRE(s.tip_rad > 0.01);
  const auto stands_on_plate_tilted = [&](double tilt_rad) {  // where the weight's line meets the plate
    const Vec3 down = -std::cos(tilt_rad) * standing.support.frame.up + std::sin(tilt_rad) * s.heading;
    const Vec2 foot = standing.support.frame.on_plate(s.com_mm + (s.com_height_mm / std::cos(tilt_rad)) * down);
    for (const SupportEdge& edge : standing.support.edges())
      if (dot(edge.inward, foot - edge.from_mm) < 0) return false;
    return true;
  };
  RC_ASSERT(stands_on_plate_tilted(s.tip_rad - 1e-9));
  RC_ASSERT(!stands_on_plate_tilted(s.tip_rad + 1e-9));
}

RC_GTEST_PROP(Standing, WorsensWithEveryToleranceThatIsAdded, ()) {
  const TriangleMesh figure = random_figure();
  const StandingPose pose{.xy_error_mm = number_in(0, 1)};
  const SupportPolygon support = support_polygon(figure, pose).value();
  const Moments whole = moments(figure), part = moments(test::box({0, 0, 1}, {2, 3, number_in(2, 9)}));
  const double error = number_in(0, 1) / 2;
  const std::vector<Region> exact{{whole, 1.24, 0}, {part, 7.85, 0}}, loose{{whole, 1.24, error}, {part, 7.85, 0.01}};
  const Stability without = measure_stability(support, exact, pose), with = measure_stability(support, loose, pose);
  RC_ASSERT(without.robust_tip_rad <= without.tip_rad + 1e-14);
  RC_ASSERT(with.robust_tip_rad <= without.robust_tip_rad + 1e-14);
  assert_near(with.tip_rad, without.tip_rad, 1e-14);
}

RC_GTEST_PROP(Moments, AddOverTheHalvesOfACutSolid, ()) {
  const Vec3 size{number_in(1, 50), number_in(1, 50), number_in(1, 50)};
  const double cut = size.z * number_in(0, 1);
  RC_PRE(cut > 0.01 && cut < size.z - 0.01);
  const Moments whole = moments(test::box({0, 0, 0}, size));
  const Moments halves = moments(test::box({0, 0, 0}, {size.x, size.y, cut})) + moments(test::box({0, 0, cut}, size));
  assert_near(halves.volume_mm3, whole.volume_mm3, 1e-9);
  assert_near(halves.first_mm4.z, whole.first_mm4.z, 1e-7);
}

}  // namespace
}  // namespace aplomb
