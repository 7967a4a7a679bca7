#include "aplomb/ending.h"

#include <gtest/gtest.h>

#include "aplomb/input.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

Report report_with(Outcome outcome, bool is_spoilt) {
  Report report;
  report.outcome = outcome;
  report.judgement.emplace();
  if (is_spoilt) {
    Finding finding;
    finding.id = "wall.thin";
    finding.severity = Severity::fail;
    report.judgement->findings.push_back(finding);
    report.judgement->checks.push_back({"wall.thin", CheckResult::Verdict::failed, true, 0, 1, {}});
  }
  return report;
}

TEST(Ending, HasTheNumbersThatAreDocumentedAsExitCodes) {
  EXPECT_EQ(static_cast<int>(ending_of(Error{ErrorCode::invalid_option, {}})), 1);
  EXPECT_EQ(static_cast<int>(ending_of(Error{ErrorCode::unusable_input, {}})), 2);
  EXPECT_EQ(static_cast<int>(ending_of(Error{ErrorCode::file_system, {}})), 2);
  EXPECT_EQ(static_cast<int>(ending_of(Error{ErrorCode::cancelled, {}})), 4);
  EXPECT_EQ(static_cast<int>(ending_of(Error{ErrorCode::over_budget, {}})), 5);
  EXPECT_EQ(static_cast<int>(ending_of(Error{ErrorCode::third_party, {}})), 7);
  EXPECT_EQ(static_cast<int>(ending_of(Error{ErrorCode::internal, {}})), 7);
}

TEST(Ending, OfARunThatFallsComesBeforeWhatDoesNotPrint) {
  EXPECT_EQ(ending_of(report_with(Outcome::stands, false)), Ending::stands);
  EXPECT_EQ(ending_of(report_with(Outcome::already_stands, true)), Ending::does_not_print);
  for (const bool is_spoilt : {false, true}) {
    EXPECT_EQ(ending_of(report_with(Outcome::best_effort, is_spoilt)), Ending::cannot_stand);
    EXPECT_EQ(ending_of(report_with(Outcome::falls, is_spoilt)), Ending::cannot_stand);
  }
}

TEST(Refusal, NamesTheCheckUnlessTheBestEffortWasAskedFor) {
  const auto why = refusal(report_with(Outcome::stands, true), {});
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("wall.thin"), std::string::npos);
  EXPECT_FALSE(refusal(report_with(Outcome::stands, true), {.best_effort = true}));
  EXPECT_FALSE(refusal(report_with(Outcome::stands, false), {}));
  EXPECT_TRUE(refusal(report_with(Outcome::best_effort, false), {}));
  EXPECT_FALSE(refusal(report_with(Outcome::best_effort, false), {.best_effort = true}));
}

TEST(Input, OfAMeshInMemoryIsThatOfItsFile) {
  const TriangleMesh box = test::box({0, 0, 0}, {10, 20, 30});
  const auto input = load_solid(MeshFile{"mesh in memory", 1, true, {{"box", box}}, {}}, {});
  ASSERT_TRUE(input);
  EXPECT_NEAR(input->moments.volume_mm3, 6000, 1e-9);
  const auto two =
      load_solid(MeshFile{"mesh in memory", 1, true, {{"a", box}, {"b", test::box({50, 0, 0}, {60, 10, 10})}}, {}}, {});
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().code, ErrorCode::unusable_input);
  InputOptions second_of_them;
  second_of_them.object = 2;
  const auto second =
      load_print(MeshFile{"", 1, true, {{"a", box}, {"b", test::box({50, 0, 0}, {60, 10, 10})}}, {}}, second_of_them);
  ASSERT_TRUE(second);
  EXPECT_NEAR(bounding_box(*second).min.x, 50, 1e-9);
}

}  // namespace
}  // namespace aplomb
