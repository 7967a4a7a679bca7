#include "aplomb/deform/deform_cage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shapes.h"
#include "support/tet_boxes.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;

CageDeformation bent(const CageProblem& problem, const DeformOptions& options = {}) {
  const auto result = deform_cage(problem, options);
  EXPECT_TRUE(result.has_value());
  return *result;
}

double lowest_mm(const std::vector<Vec3>& vertices) {
  double least = 1e300;
  for (const Vec3& v : vertices) least = std::min(least, v.z);
  return least;
}

TEST(DeformCage, ALeaningBarReachesTheAngleAskedFor) {
  for (const double tip : {5.0, 15.0, 25.0}) {
    const CageProblem problem = test::leaning_bar(25, tip * degree);
    const CageDeformation result = bent(problem);
    EXPECT_EQ(result.outcome, DeformOutcome::reached);
    EXPECT_GE(result.t, problem.required_t);
    EXPECT_LT(result.t, problem.required_t + 1e-4);  // no more than asked
    const test::VolumeRange volumes = test::volume_range(problem.rest, result.vertices);
    EXPECT_GT(volumes.least, 0.8);
    EXPECT_LT(volumes.most, 1.2);
    EXPECT_GE(lowest_mm(result.vertices), -1e-3);
    EXPECT_LE(result.iterations, 15);
  }
}

TEST(DeformCage, TheAngleReachedIsThatOfTheDeformedSolidCarvedByTheHalfSpaceItNames) {
  const CageProblem problem = test::leaning_bar(25, 10 * degree);
  const CageDeformation result = bent(problem);
  Moments body;  // samples are in or out here, not cut: hence the tolerance
  for (const SolidSample& sample : problem.samples) {
    const auto& [a, b, c, d] = problem.rest.tets[sample.at.tet];
    const auto volume = [&](const std::vector<Vec3>& v) { return signed_volume(v[a], v[b], v[c], v[d]); };
    const Vec3 at = sample.at.position(problem.rest, result.vertices);
    const double kept = result.kept(at) > 0 ? 1 : 1 - sample.carvable;
    const double change = volume(result.vertices) / volume(problem.rest.vertices);
    body += kept * sample.volume_mm3 * change * Moments{1, at};
  }
  EXPECT_NEAR(largest_t(problem.balance, body), result.t, 0.02);
}

TEST(DeformCage, ContactsStayWhereTheyAre) {
  const CageProblem problem = test::leaning_bar(25, 15 * degree);
  const CageDeformation result = bent(problem);
  for (std::size_t v = 0; v < problem.fixed.size(); ++v) {
    if (!problem.fixed[v]) continue;
    EXPECT_EQ(result.vertices[v], problem.rest.vertices[v]);
  }
}

TEST(DeformCage, WhatStandsAlreadyStaysAsItIs) {
  const CageProblem problem = test::leaning_bar(5, 3 * degree);
  const CageDeformation result = bent(problem);
  EXPECT_EQ(result.outcome, DeformOutcome::reached);
  EXPECT_NEAR(result.max_mm, 0, 1e-9);
  EXPECT_NEAR(result.energy_mm3, 0, 1e-9);
}

TEST(DeformCage, EveryIterateIsUprightAndNoPlateIsPierced) {
  const CageProblem problem = test::leaning_bar(25, 30 * degree);
  int iterates = 0;
  const auto result = deform_cage(problem, {}, [&](const std::vector<Vec3>& vertices, double) {
    EXPECT_GT(test::volume_range(problem.rest, vertices).least, 0);
    EXPECT_GE(lowest_mm(vertices), -0.05);
    ++iterates;
  });
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(iterates, result->iterations);
}

TEST(DeformCage, CarvingTogetherWithBendingMovesLessThanBendingTheSolid) {
  CageProblem problem = test::leaning_bar(25, 10 * degree);
  const CageDeformation together = bent(problem);
  for (SolidSample& sample : problem.samples) sample.carvable = 0;
  const CageDeformation solid = bent(problem);
  EXPECT_EQ(solid.outcome, DeformOutcome::reached);
  EXPECT_LT(together.mean_mm, 0.9 * solid.mean_mm);
}

TEST(DeformCage, AskedForFarTooMuchEndsAtTheLimitInGoodShape) {
  const CageProblem problem = test::leaning_bar(25, 75 * degree);
  const CageDeformation result = bent(problem, {.most_mean_mm = 3});
  EXPECT_EQ(result.outcome, DeformOutcome::limit);
  EXPECT_LE(result.mean_mm, 3 + 1e-9);
  EXPECT_GT(result.mean_mm, 3 - 1e-3);
  EXPECT_GT(result.t, 0.06);  // it leant by -0.023 before
  EXPECT_LT(result.max_turn_rad, 15 * degree);
  const test::VolumeRange volumes = test::volume_range(problem.rest, result.vertices);
  EXPECT_GT(volumes.least, 0.9);
  EXPECT_LT(volumes.most, 1.1);
}

TEST(DeformCage, TheBestWithinALimitIsWhatAskingForItNeeds) {
  CageProblem problem = test::leaning_bar(25, 60 * degree);
  const CageDeformation limited = bent(problem, {.most_mean_mm = 8});
  problem.required_t = limited.t;
  const CageDeformation asked = bent(problem);
  EXPECT_NEAR(asked.mean_mm, limited.mean_mm, 0.05);
}

TEST(DeformCage, WhatNoShapeCanDoEndsStuckButNeverInverted) {
  const CageProblem problem = test::leaning_bar(25, 89 * degree);
  const CageDeformation result = bent(problem, {.most_iterations = 25});
  EXPECT_EQ(result.outcome, DeformOutcome::stuck);
  EXPECT_EQ(result.iterations, 25);
  EXPECT_GT(test::volume_range(problem.rest, result.vertices).least, 0);
}

TEST(DeformCage, TurnsWithItsProblem) {
  CageProblem problem = test::leaning_bar(25, 12 * degree, 3);
  problem.handles.push_back({problem.samples.back().at, {20, 5, 58}, 0.01});
  const double angle = 0.6;
  const CageDeformation result = bent(problem), turned = bent(test::turned_about_z(problem, angle));
  const Affine3 turn = test::rotation({0, 0, 1}, angle);
  for (std::size_t v = 0; v < result.vertices.size(); ++v)
    EXPECT_NEAR(norm(turned.vertices[v] - turn * result.vertices[v]), 0, 1e-6);
}

TEST(DeformCage, AStiffRegionKeepsItsShape) {
  CageProblem problem = test::leaning_bar(25, 12 * degree);
  for (std::size_t t = 0; t < problem.rest.tets.size(); ++t)
    if (problem.rest.vertices[problem.rest.tets[t][0]].z > 30) problem.stiffness[t] = 1e4;
  const CageDeformation result = bent(problem);
  EXPECT_EQ(result.outcome, DeformOutcome::reached);
  for (const auto& [a, b, c, d] : problem.rest.tets)
    if (problem.rest.vertices[a].z > 30) {
      const double rest = norm(problem.rest.vertices[a] - problem.rest.vertices[b]);
      EXPECT_NEAR(norm(result.vertices[a] - result.vertices[b]), rest, 0.01 * rest);
    }
}

TEST(DeformCage, AHandlePullsAPointToItsTarget) {
  CageProblem problem = test::leaning_bar(0, -80 * degree);
  const SolidSample& top = problem.samples.back();
  const Vec3 target = top.at.position(problem.rest, problem.rest.vertices) + Vec3{0, 4, 0};
  problem.handles.push_back({top.at, target, 1000});
  const CageDeformation result = bent(problem);
  EXPECT_EQ(result.outcome, DeformOutcome::reached);
  EXPECT_NEAR(norm(top.at.position(problem.rest, result.vertices) - target), 0, 0.05);
}

TEST(DeformCage, ARowWithoutAHeightHoldsToo) {
  CageProblem problem = test::leaning_bar(25, 5 * degree);
  problem.balance.rows.push_back({{-3, {0, 1, 0}}, {}});  // the centre of mass beyond y = 3
  const CageDeformation result = bent(problem);
  EXPECT_EQ(result.outcome, DeformOutcome::reached);
}

/// The bar on its middle: beyond 4 mm from the middle, the base is free to sink.
CageProblem bar_on_its_middle() {
  CageProblem problem = test::leaning_bar(25, 10 * degree);
  for (std::size_t v = 0; v < problem.fixed.size(); ++v)
    if (std::abs(problem.rest.vertices[v].x) > 6) problem.fixed[v] = false;
  return problem;
}

TEST(DeformCage, TheGroundKeepsWhatIsFreeFromSinkingBelowThePlate) {
  EXPECT_LT(lowest_mm(bent(bar_on_its_middle(), {.ground_ratio = 0}).vertices), -0.5);
  const CageDeformation result = bent(bar_on_its_middle());
  EXPECT_EQ(result.outcome, DeformOutcome::reached);
  EXPECT_GE(lowest_mm(result.vertices), -0.02);
}

TEST(DeformCage, TwoPosesAreMetAtOnce) {
  const double lean_mm = 12;
  CageProblem problem = test::leaning_bar(lean_mm, 10 * degree);
  for (SolidSample& sample : problem.samples) sample.carvable = 0;
  const auto standing = problem.balance.rows;
  for (const BalanceRow& row : standing) {  // on its head, where 3 degrees are enough
    const double less = std::tan(10 * degree) - std::tan(3 * degree);
    AffineForm a = row.a, b = {60, {0, 0, -1}};
    a.constant -= lean_mm * a.gradient.x;
    problem.balance.rows.push_back({a + less * b, b});
  }
  problem.grounds.push_back({{0, 0, -1}, -60});
  for (std::size_t v = 0; v < problem.fixed.size(); ++v)
    if (problem.rest.vertices[v].z == 60) problem.fixed[v] = true;
  const CageDeformation result = bent(problem);
  EXPECT_EQ(result.outcome, DeformOutcome::reached);
  EXPECT_LT(result.max_turn_rad, 20 * degree);
  EXPECT_GT(result.max_mm, 0.5);
}

TEST(DeformCage, HangsWithinTheTiltAskedFor) {
  CageProblem problem = test::leaning_bar(25, 0);
  const Vec3 hook{25, 0, 60};  // in the middle of the top: the centre of mass is 12.5 mm beside it
  problem.balance.rows.clear();
  for (int i = 0; i < 16; ++i) {
    const double heading = i * std::numbers::pi / 8;
    const Vec3 n{std::cos(heading), std::sin(heading), 0};
    problem.balance.rows.push_back({{dot(n, hook), -n}, {hook.z, {0, 0, -1}}});
  }
  problem.required_t = -std::tan(3 * degree);
  for (std::size_t v = 0; v < problem.fixed.size(); ++v) problem.fixed[v] = problem.rest.vertices[v].z == 60;
  problem.grounds.clear();
  const CageDeformation result = bent(problem);
  EXPECT_EQ(result.outcome, DeformOutcome::reached);
  EXPECT_GE(result.t, problem.required_t);
}

TEST(DeformCage, GivesTheSameBytesTwice) {
  const CageProblem problem = test::leaning_bar(25, 12 * degree);
  EXPECT_EQ(bent(problem).vertices, bent(problem).vertices);
}

TEST(DeformCage, WithNothingFixedTheBalanceAloneHoldsIt) {
  CageProblem problem = test::leaning_bar(25, 5 * degree, 3);
  problem.fixed.assign(problem.fixed.size(), false);
  const CageDeformation result = bent(problem);
  EXPECT_EQ(result.outcome, DeformOutcome::reached);
}

TEST(DeformCage, StopsWhenTheJobSaysSo) {
  for (int stop = 1; stop <= 4; ++stop) {
    int reports = 0;
    const auto result = deform_cage(test::leaning_bar(25, 25 * degree, 3), {}, {},
                                    Job([&](double, std::string_view) { return ++reports < stop; }));
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
    EXPECT_EQ(reports, stop);
  }
}

TEST(DeformOptions, EveryFieldIsNamedWhenItIsOutsideItsRange) {
  EXPECT_EQ(find_problem(DeformOptions{}), "");
  const std::pair<DeformOptions, const char*> wrong[] = {
      {{.alpha_ratio = 0}, "alpha_ratio"},   {{.beta_ratio = -1}, "beta_ratio"},
      {{.gamma_ratio = NAN}, "gamma_ratio"}, {{.ground_ratio = 1e7}, "ground_ratio"},
      {{.most_mean_mm = 0}, "most_mean_mm"}, {{.most_step_mm = 0}, "most_step_mm"},
      {{.settled_mm = 0}, "settled_mm"},     {{.most_iterations = -1}, "most_iterations"}};
  for (const auto& [options, field] : wrong) EXPECT_EQ(find_problem(options).rfind(field, 0), 0u) << field;
}

}  // namespace
}  // namespace aplomb
