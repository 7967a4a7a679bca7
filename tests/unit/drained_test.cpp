#include "aplomb/drained.h"

#include <gtest/gtest.h>

#include "aplomb/holes/undrained.h"
#include "aplomb/mesh/solid_mesh.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

StandOptions options_for(Process process) {
  StandOptions options;
  options.holes = Holes::automatic;
  options.judge.rules = Rules(process);
  options.wall_mm = 2;
  options.voxel_mm = 0.8;
  options.best_effort = true;
  std::get<StandingPose>(options.poses.front().way).required_tip_rad = 0.24;
  return options;
}

Input leaning_block() {
  Input input{test::solid_of(test::leaning_prism(30, 30, 60, 18)), {}, {}, {}, {}};
  input.moments = input.solid.moments();
  return input;
}

/// Carved, and not yet drilled.
Attempt carved(const Input& input, StandOptions options) {
  options = with_voids_for_holes(options);
  StageSeconds seconds;
  StageClock clock(seconds);
  const auto volume =
      voxelize(input.solid, {options.wall_mm, voxel_mm(options, input.solid.box()), options.least_void_mm});
  const auto joint = joint_problem(input.solid.mesh(), options.poses, kind_of(options));
  return carve_shell(*volume, input, *joint, options, {}, clock, {}).value();
}

Result<Attempt> drained_with(const Attempt& attempt, const Input& input, Process process, const Job& job = {}) {
  StageSeconds seconds;
  StageClock clock(seconds);
  return drained(attempt, input, with_voids_for_holes(options_for(process)), clock, job);
}

class Drained : public testing::TestWithParam<Process> {};

TEST_P(Drained, HasNothingThatTheJudgeFailsAndStillReaches) {
  const Input input = leaning_block();
  const auto made = drained_with(carved(input, options_for(GetParam())), input, GetParam());
  ASSERT_TRUE(made && made->shell);
  EXPECT_GE(made->holes.size(), 2U);
  EXPECT_TRUE(undrained(made->shell->mesh, Rules(GetParam()))->empty());
  EXPECT_TRUE(made->carving.reaches);
  const double t = largest_t(made->joint.problem, moments(made->shell->mesh));
  EXPECT_GE(t, made->joint.required_t);
  EXPECT_NEAR(made->carving.t, t, 1e-9);  // of the holes as cut, not of those that it was carved with
  EXPECT_LE(t, made->carving.bound_t + 1e-4);
}

INSTANTIATE_TEST_SUITE_P(All, Drained, testing::Values(Process::sla, Process::powder, Process::binder),
                         [](const auto& process) { return std::string(process_names[std::size_t(process.param)]); });

TEST(DrainedVoid, StaysSolidWhereNoHoleMayBe) {
  const Input input = leaning_block();
  StandOptions options = with_voids_for_holes(options_for(Process::powder));
  options.reshape.regions.kept.push_back({{0, 0, 30}, 100});
  StageSeconds seconds;
  StageClock clock(seconds);
  const auto made = drained(carved(input, options), input, options, clock, {});
  ASSERT_TRUE(made && made->shell);
  EXPECT_EQ(made->shell->voids, 0U);
  EXPECT_TRUE(made->holes.empty());
  EXPECT_FALSE(made->hints.empty());
  const double t = largest_t(made->joint.problem, input.moments);  // the solid's, and not those of the void that went
  EXPECT_EQ(made->carving.body.volume_mm3, input.moments.volume_mm3);
  EXPECT_NEAR(made->carving.t, t, 1e-9);
  EXPECT_LE(t, made->carving.bound_t + 1e-6);
  EXPECT_FALSE(made->carving.reaches);
}

TEST(DrainedVoid, IsCancelledAtAnyReport) {
  const Input input = leaning_block();
  const Attempt attempt = carved(input, options_for(Process::powder));
  test::CancelAt never(1 << 30);
  ASSERT_TRUE(drained_with(attempt, input, Process::powder, never.job()).has_value());
  for (int k = 1; k <= never.reports(); k += 1 + never.reports() / 10) {
    test::CancelAt at_k(k);
    const auto result = drained_with(attempt, input, Process::powder, at_k.job());
    if (at_k.reports() < k) {  // a child process reports as time goes by: fewer reports this time
      EXPECT_GT(k, never.reports() / 2) << "never came to report " << k;
      continue;
    }
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace aplomb
