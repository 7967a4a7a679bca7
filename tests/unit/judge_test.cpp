#include "aplomb/printability/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aplomb/printability/mesh_checks.h"
#include "aplomb/printability/printed_solid.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb::test {
namespace {

using Verdict = CheckResult::Verdict;

/// Of one check; a name that the process has no check for is a failure.
CheckResult result_of(const Judgement& judgement, std::string_view id) {
  const auto found = std::ranges::find(judgement.checks, id, &CheckResult::id);
  EXPECT_NE(found, judgement.checks.end()) << id;
  return found == judgement.checks.end() ? CheckResult{} : *found;
}

Judgement judged(const TriangleMesh& mesh, const JudgeOptions& options = {}) { return judge(mesh, options).value(); }

TriangleMesh cube(double size) { return box({0, 0, 0}, {size, size, size}); }

/// A cube with a ball of emptiness in its middle.
TriangleMesh hollow_cube(double size, double radius) {
  return joined(cube(size), reversed(sphere({size / 2, size / 2, size / 2}, radius, 4)));
}

TEST(Judge, FindsNothingInSoundShapesForAnyProcess) {
  for (const Process process : {Process::fdm, Process::sla, Process::powder, Process::binder})
    for (const TriangleMesh& mesh : {cube(20), box({0, 0, 0}, {40, 40, 4}), star_prism(7, 20, 12, 15)}) {
      const Judgement judgement = judged(mesh, {Rules(process)});
      EXPECT_TRUE(judgement.passes());
      EXPECT_TRUE(judgement.findings.empty()) << judgement.findings.front().text;
    }
}

TEST(Judge, TellsWhatIsWrongWithAMeshAndWhere) {
  TriangleMesh open = cube(10);
  open.triangles.pop_back();
  const Judgement judgement = judged(open);
  EXPECT_FALSE(judgement.passes());
  ASSERT_EQ(judgement.findings.size(), 1u);
  const Finding& finding = judgement.findings.front();
  EXPECT_EQ(finding.id, "mesh.manifold");
  EXPECT_EQ(finding.measured, 3);
  EXPECT_FALSE(finding.box_mm.empty());
  EXPECT_EQ(result_of(judgement, "stand.nominal").verdict, Verdict::not_judged);
  EXPECT_EQ(result_of(judgement, "mesh.orientation").verdict, Verdict::not_judged);
  EXPECT_EQ(result_of(judged(reversed(cube(10))), "mesh.orientation").verdict, Verdict::failed);
}

TEST(Judge, FindsCrossingBodiesInTheBoxWhereTheyCross) {
  const Judgement judgement = judged(joined(cube(10), box({8, 2, 2}, {18, 6, 6})));
  EXPECT_EQ(result_of(judgement, "mesh.intersection").verdict, Verdict::failed);
  EXPECT_GE(judgement.findings.front().box_mm.max.x, 10);
  TriangleMesh doubled = cube(10);
  doubled.triangles.push_back(doubled.triangles.front());
  EXPECT_EQ(result_of(judged(doubled), "mesh.degenerate").verdict, Verdict::failed);
}

/// A void that is wound like its outside is what slicers fill.
TEST(Judge, RefusesAVoidThatIsWoundLikeABody) {
  const TriangleMesh wrong = joined(cube(30), sphere({15, 15, 15}, 8, 4));
  EXPECT_EQ(result_of(judged(wrong), "mesh.orientation").verdict, Verdict::failed);
  EXPECT_EQ(result_of(judged(hollow_cube(30, 8)), "mesh.orientation").verdict, Verdict::passed);
}

/// A column of width w and height h stands to atan(w / h).
TEST(Judge, TurnsItsVerdictOnStandingAtTheAngleAskedFor) {
  for (const double share : {0.98, 1.02}) {
    const double width = share * 100 * std::tan(10 * M_PI / 180);
    const CheckResult result = result_of(judged(box({0, 0, 0}, {width, width, 100})), "stand.nominal");
    EXPECT_EQ(result.verdict, share < 1 ? Verdict::failed : Verdict::passed);
    EXPECT_NEAR(result.measured, std::atan(width / 100) * 180 / M_PI, 1e-3);
  }
  JudgeOptions lenient;
  lenient.pose->required_tip_rad = 4 * M_PI / 180;
  EXPECT_EQ(result_of(judged(box({0, 0, 0}, {10, 10, 100}), lenient), "stand.nominal").verdict, Verdict::passed);
  lenient.pose.reset();
  EXPECT_EQ(result_of(judged(cube(10), lenient), "stand.nominal").verdict, Verdict::not_judged);
}

TEST(Judge, WarnsOfARobustAngleBelowTheOneAskedForAndFailsBelowHalfOfIt) {
  const auto verdict_at = [](double tip_deg) {
    const double width = 100 * std::tan(tip_deg * M_PI / 180);
    return result_of(judged(box({0, 0, 0}, {width, width, 100})), "stand.robust").verdict;
  };
  EXPECT_EQ(verdict_at(12), Verdict::passed);
  EXPECT_EQ(verdict_at(8), Verdict::warned);
  EXPECT_EQ(verdict_at(4), Verdict::failed);
}

/// A void at the top, full of liquid, is nearly no void.
TEST(Judge, WeighsWhatStaysInClosedVoids) {
  const TriangleMesh mesh = joined(box({0, 0, 0}, {30, 30, 100}), reversed(box({3, 3, 50}, {27, 27, 97})));
  const Judgement judgement = judged(mesh, {Rules(Process::sla)});
  const double empty = result_of(judgement, "stand.nominal").measured;
  const double full = result_of(judgement, "stand.trapped").measured;
  const double outer_mm3 = 90000, void_mm3 = 24.0 * 24 * 47, left = 0.05 * void_mm3;
  const double height = (outer_mm3 * 50 - left * 73.5) / (outer_mm3 - left);
  EXPECT_NEAR(full, std::atan(15 / height) * 180 / M_PI, 1e-3);
  EXPECT_GT(empty, full + 3);
}

TEST(Judge, FindsNothingTrappedWhereThereIsNoVoid) {
  EXPECT_FALSE(result_of(judged(box({0, 0, 0}, {5, 5, 100}), {Rules(Process::sla)}), "stand.trapped").has_measure);
}

Finding finding_at(const char* id, Severity severity, Vec3 at_mm) {
  Finding finding;
  finding.id = id;
  finding.severity = severity;
  finding.measured = 3;
  finding.box_mm.add(at_mm);
  return finding;
}

TEST(Inherited, IsWhatTheModelHadAtThatPlaceAsSevere) {
  Judgement input, made;
  input.findings = {finding_at("wall.thin", Severity::warn, {0, 0, 0}),
                    finding_at("strength.ankle", Severity::fail, {0, 0, 9})};
  made.findings = {finding_at("wall.thin", Severity::warn, {0, 0, 1.9}),       // near enough
                   finding_at("wall.thin", Severity::fail, {0, 0, 1}),         // worse than it was
                   finding_at("void.island", Severity::fail, {0, 0, 0}),       // another check
                   finding_at("strength.ankle", Severity::fail, {0, 0, 9}),    // the same
                   finding_at("strength.ankle", Severity::fail, {0, 0, 20})};  // elsewhere
  mark_inherited(made, input, 2);
  std::vector<bool> inherited;
  for (const Finding& f : made.findings) inherited.push_back(f.in_input.has_value());
  EXPECT_EQ(inherited, (std::vector<bool>{true, false, false, true, false}));
  EXPECT_EQ(made.new_failures(), (std::vector<std::string>{"wall.thin", "void.island", "strength.ankle"}));
  made.checks = {{"void.island", Verdict::waived, true, 3, 0, {}}};
  EXPECT_EQ(made.new_failures(), (std::vector<std::string>{"wall.thin", "strength.ankle"}));
}

TEST(Inherited, IsAllOfAFindingAboutTheWholeModel) {
  Judgement input, made;
  input.findings = {finding_at("mesh.manifold", Severity::fail, {})};
  input.findings.front().box_mm = {};
  made.findings = {finding_at("mesh.manifold", Severity::fail, {50, 0, 0})};
  mark_inherited(made, input, 0);
  EXPECT_TRUE(made.new_failures().empty());
}

/// PRINTABILITY's model of a spherical void in a sparse print: f R^3 = (1 - f) ((R + t)^3 - R^3).
TEST(Judge, TurnsItsVerdictOnMassAtTheBreakEvenOfASphere) {
  for (const double f : {0.15, 0.4}) {
    const double skin = 1.35, radius = skin / (std::cbrt(1 / (1 - f)) - 1);
    for (const double share : {0.98, 1.02}) {
      JudgeOptions options;
      options.filling.infill_ratio = f;
      const double size = 4 * radius;
      const TriangleMesh mesh = joined(cube(size), reversed(sphere({size / 2, size / 2, size / 2}, share * radius, 6)));
      EXPECT_EQ(result_of(judged(mesh, options), "mass.gained").verdict, share < 1 ? Verdict::failed : Verdict::passed)
          << f;
    }
  }
  EXPECT_EQ(result_of(judged(hollow_cube(30, 5)), "mass.gained").verdict, Verdict::passed);  // printed solid
}

TEST(Judge, AcceptsWhatIsWaived) {
  const TriangleMesh column = box({0, 0, 0}, {10, 10, 100});
  JudgeOptions options;
  EXPECT_FALSE(judged(column, options).passes());
  ASSERT_TRUE(options.rules.waive("stand.nominal"));
  EXPECT_TRUE(judged(column, options).passes());
  EXPECT_EQ(result_of(judged(column, options), "stand.nominal").verdict, Verdict::waived);
}

TEST(Judge, ComparesWhatWasReadBackWithWhatWasMeant) {
  const TriangleMesh meant = hollow_cube(30, 8);
  EXPECT_EQ(roundtrip_error_ratio(meant, meant), 0);
  EXPECT_LT(roundtrip_error_ratio(meant, rounded_to_float(meant)), 1e-6);
  TriangleMesh moved = meant;
  moved.vertices.back().z += 1;  // the void's: the volume changes little, a section more
  EXPECT_GT(roundtrip_error_ratio(meant, moved), 1e-6);
  moved = meant;
  moved.triangles.pop_back();
  EXPECT_TRUE(std::isinf(roundtrip_error_ratio(meant, moved)));
  EXPECT_EQ(result_of(judge(rounded_to_float(meant), {}, &meant).value(), "mesh.roundtrip").verdict, Verdict::passed);
}

TEST(Judge, StopsWhenAskedTo) {
  CancelAt cancel(1);
  const auto result = judge(cube(10), {}, nullptr, cancel.job());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

TEST(JudgeOptions, AreRefusedFieldByField) {
  JudgeOptions options;
  options.rules.layer_mm = 0;
  EXPECT_EQ(find_problem(options), "layer_mm is 0; it must lie in (0, 100]");
  options = {};
  options.filling.infill_ratio = 1.5;
  EXPECT_EQ(find_problem(options), "infill_ratio is 1.5; it must lie in [0, 1]");
  EXPECT_EQ(find_problem(JudgeOptions{}), "");
}

}  // namespace
}  // namespace aplomb::test
