#include "aplomb/ceilings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "aplomb/carve/kept_parts.h"
#include "aplomb/pipeline.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/walls.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

constexpr std::array<std::string_view, 4> shaped_for{"void.bridge", "void.slope", "void.island", "wall.void_void"};

StandOptions options_of(Ceiling ceiling, CarveAim aim = CarveAim::stable) {
  StandOptions options;
  options.ceiling = ceiling;
  options.aim = aim;
  options.wall_mm = 2;
  options.voxel_mm = 0.8;
  options.best_effort = true;
  std::get<StandingPose>(options.poses.front().way).required_tip_rad = 0.3;
  return options;
}

Input input_of(const TriangleMesh& mesh) {
  Input input{test::solid_of(mesh), {}, {}, {}, {}};
  input.moments = input.solid.moments();
  return input;
}

/// A void's findings of these checks, by the judge itself.
std::vector<Finding> findings(const StandRun& run, const StandOptions& options) {
  std::vector<Finding> found = judge(run.shell->mesh, {options.judge.rules, std::nullopt}).value().findings;
  std::erase_if(found, [](const Finding& f) { return std::ranges::find(shaped_for, f.id) == shaped_for.end(); });
  return found;
}

struct Pair {
  StandRun any, shaped;
};

Pair both(const TriangleMesh& mesh, CarveAim aim = CarveAim::stable) {
  const Input input = input_of(mesh);
  return {stand(input, options_of(Ceiling::any, aim)).value(),
          stand(input, options_of(Ceiling::automatic, aim)).value()};
}

/// Ceilings as they come are found wrong, shaped ones are not, and the certificates say what it cost.
void expect_shaped(const TriangleMesh& mesh) {
  const auto [any, shaped] = both(mesh);
  EXPECT_FALSE(findings(any, options_of(Ceiling::any)).empty());
  for (const Finding& finding : findings(shaped, options_of(Ceiling::automatic))) ADD_FAILURE() << finding.text;
  EXPECT_EQ(describe(check_solid(shaped.shell->mesh).value().defects), "no defect");
  EXPECT_GE(shaped.shell->wall_mm, 2);
  EXPECT_LE(shaped.carving->t, shaped.carving->bound_t + 1e-9);
  EXPECT_LT(shaped.carving->bound_t, any.carving->bound_t);
  const CeilingFigures& figures = shaped.report.carving->ceiling.value();
  EXPECT_EQ(figures.left, 0u);
  EXPECT_GT(figures.ribs, 0u);
  EXPECT_NEAR(figures.bound_rad, std::atan(any.carving->bound_t), 1e-9);
  EXPECT_NEAR(figures.cost_rad, std::atan(any.carving->bound_t) - std::atan(shaped.carving->bound_t), 1e-9);
}

TEST(Ceilings, of_a_cube_print_in_every_scale) {
  for (const double side : {24.0, 40.0}) expect_shaped(test::box({0, 0, 0}, {side, side, side}));
}

TEST(Ceilings, of_a_tall_box_print_whichever_way_it_is_turned) {
  for (const double turn : {0.0, 0.5})
    expect_shaped(transformed(test::box({-12, -12, 0}, {12, 12, 60}), test::rotation({0, 0, 1}, turn)));
}

TEST(Ceilings, of_a_ball_print_in_every_scale) {
  for (const double radius : {14.0, 22.0}) {  // on a foot
    std::vector<Vec2> profile{{0, 0}, {0.5 * radius, 0}, {0.5 * radius, 1}};
    for (int i = 4; i < 24; ++i) {
      const double angle = std::numbers::pi * i / 24;
      profile.push_back({radius * std::sin(angle), radius * (1 - std::cos(angle))});
    }
    profile.push_back({0, 2 * radius});
    expect_shaped(test::lathe(profile, 48));
  }
}

TEST(Ceilings, cost_a_leaning_box_a_small_part_of_what_carving_gains) {
  const TriangleMesh leaning = test::leaning_prism(30, 30, 50, 20);
  expect_shaped(leaning);
  const auto [any, shaped] = both(leaning);
  const double solid_t =
      largest_t(joint_problem(leaning, std::vector{Pose{}}, RowKind::nominal)->problem, input_of(leaning).moments);
  EXPECT_GT(shaped.carving->t - solid_t, 0.8 * (any.carving->t - solid_t));
}

TEST(Ceilings, that_print_already_change_nothing) {
  const auto [any, shaped] = both(test::box({0, 0, 0}, {12, 12, 40}));
  ASSERT_GT(any.shell->voids, 0u);
  EXPECT_EQ(any.shell->mesh, shaped.shell->mesh);
  EXPECT_EQ(any.carving->body, shaped.carving->body);
  EXPECT_EQ(shaped.report.carving->ceiling->rounds, 0u);
}

TEST(Ceilings, follow_the_limits_that_the_user_sets_and_waives) {
  const Input input = input_of(test::box({0, 0, 0}, {12, 12, 40}));  // spans 7.6
  StandOptions options = options_of(Ceiling::automatic);
  ASSERT_TRUE(options.judge.rules.set("void.bridge", 6).has_value());
  const StandRun narrow = stand(input, options).value();
  EXPECT_GT(narrow.report.carving->ceiling->ribs, 0u);
  EXPECT_TRUE(findings(narrow, options).empty());
  for (const std::string_view id : shaped_for) ASSERT_TRUE(options.judge.rules.waive(id).has_value());
  const StandRun waived = stand(input, options).value();
  EXPECT_EQ(waived.report.carving->ceiling->rounds, 0u);
  EXPECT_EQ(waived.shell->mesh, stand(input, options_of(Ceiling::any))->shell->mesh);
}

TEST(Ceilings, are_shaped_for_fdm_alone_unless_asked_for) {
  StandOptions options;
  EXPECT_TRUE(shapes_ceilings(options));
  for (const Process process : {Process::sla, Process::powder, Process::binder}) {
    options.judge.rules = Rules(process);
    EXPECT_FALSE(shapes_ceilings(options));
  }
  options.ceiling = Ceiling::automatic;
  EXPECT_TRUE(shapes_ceilings(options));
}

TEST(Ceilings, hold_with_the_least_void_that_still_reaches_the_angle) {
  const auto [any, shaped] = both(test::leaning_prism(30, 30, 50, 20), CarveAim::least);
  ASSERT_TRUE(any.carving->reaches);
  EXPECT_TRUE(shaped.carving->reaches);
  EXPECT_EQ(shaped.report.outcome, Outcome::stands);
  EXPECT_TRUE(findings(shaped, options_of(Ceiling::automatic)).empty());
}

TEST(Ceilings, that_take_what_balance_needs_are_named_in_a_hint) {
  const Input input = input_of(test::leaning_prism(30, 30, 50, 20));
  StandOptions options = options_of(Ceiling::any);
  const double reachable_rad = std::atan(stand(input, options)->carving->t);
  options.aim = CarveAim::least;
  std::get<StandingPose>(options.poses.front().way).required_tip_rad = reachable_rad - 0.002;
  EXPECT_EQ(stand(input, options)->report.outcome, Outcome::stands);
  options.ceiling = Ceiling::automatic;
  const Report report = stand(input, options)->report;
  EXPECT_EQ(report.outcome, Outcome::best_effort);
  EXPECT_TRUE(std::ranges::any_of(report.hints,
                                  [](const std::string& hint) { return hint.find("--ceiling any") != hint.npos; }));
}

TEST(Ceilings, of_what_hangs_cost_as_a_tilt_does) {
  const Input input = input_of(test::box({-15, -15, 0}, {15, 15, 40}));
  StandOptions options = options_of(Ceiling::any);
  options.poses = {{"ring", HangingPose{.attachments_mm = {{6, 0, 40}}, .required_tilt_rad = 0.01}}};
  const Report any = stand(input, options)->report;
  ASSERT_EQ(any.carving->bound_of, BoundOf::tilt);
  options.ceiling = Ceiling::automatic;
  const CeilingFigures figures = stand(input, options)->report.carving->ceiling.value();
  EXPECT_GT(figures.ribs + figures.pillars + figures.fills, 0u);
  EXPECT_NEAR(figures.bound_rad, any.carving->bound_rad, 1e-9);
  EXPECT_GT(figures.bound_rad, 0);
  EXPECT_GE(figures.cost_rad, 0);
}

/// A bar 12 mm wide and 50 high whose void has a part that is kept, as carved and shaped.
struct Kept {
  Attempt as_carved, shaped;
};

Kept bar_with(const KeptPart& part) {
  const TriangleMesh bar = test::box({-6, -6, 0}, {6, 6, 50});
  const SolidMesh solid = test::solid_of(bar);
  const SolidVolume volume = without(voxelize(solid, {.wall_mm = 2, .voxel_mm = 0.5}).value(), {part});
  const JointProblem joint = joint_problem(bar, std::vector{Pose{}}, RowKind::nominal).value();
  const CarveAgain carve_again = [&](const SolidVolume& allowed, const Job&) -> Result<Attempt> {
    Carving carving = carve(allowed, solid.moments(), joint.problem, {.aim = CarveAim::stable}).value();
    Shell shell = build_shell(solid, carving.field, {.wall_mm = 2}).value();
    return Attempt{joint, std::move(carving), std::move(shell), volume};
  };
  Attempt as_carved = carve_again(volume, {}).value();
  Attempt shaped = with_printable_ceilings(as_carved, Rules(Process::fdm), carve_again).value();
  return {std::move(as_carved), std::move(shaped)};
}

double least_wall_between_voids_mm(const Attempt& attempt) {
  const SolidMesh shell = test::solid_of(attempt.shell->mesh);
  return wall_void_void(printed_solid(shell), Rules(Process::fdm)).value().at(0).measured;
}

TEST(Ceilings, are_shaped_under_a_stalactite) {  // a pin that hangs from the roof of a void
  const auto [as_carved, shaped] = bar_with(kept_box({{-1.5, -1.5, 30}, {1.5, 1.5, 49}}));
  EXPECT_GT(shaped.ceiling->pillars, 0u);
  EXPECT_EQ(shaped.ceiling->left, 0u);
  EXPECT_GT(shaped.carving.body.volume_mm3, as_carved.carving.body.volume_mm3 + 9 * 10);
}

TEST(Ceilings, come_with_walls_between_voids_that_are_thick_enough) {
  const auto [as_carved, shaped] = bar_with(kept_box({{-0.25, -6, 0}, {0.25, 6, 50}}));
  EXPECT_NEAR(least_wall_between_voids_mm(as_carved), 0.5, 0.05);
  EXPECT_GT(shaped.ceiling->fills, 0u);
  EXPECT_EQ(shaped.ceiling->left, 0u);
  EXPECT_GE(least_wall_between_voids_mm(shaped), 0.8);
}

TEST(Ceilings, fill_up_where_the_voids_of_a_dumbbell_nearly_meet) {  // two tips, 0.5 mm apart at one place
  KeptPart waist{{{-6, -6, 0}, {6, 6, 50}},
                 [](Vec3 p) { return 0.25 + 0.5 * std::hypot(p.x, p.y) - std::abs(p.z - 40); }};
  const auto [as_carved, shaped] = bar_with(waist);
  EXPECT_LT(least_wall_between_voids_mm(as_carved), 0.7);
  EXPECT_GT(shaped.ceiling->fills, 0u);
  EXPECT_EQ(shaped.ceiling->left, 0u);
  EXPECT_TRUE(shaped.shell->voids < 2 || least_wall_between_voids_mm(shaped) >= 0.8);
}

TEST(Ceilings, leave_alone_what_is_wrong_with_voids_that_the_model_brought) {
  TriangleMesh block = test::box({0, 0, 0}, {60, 60, 60});
  for (const double x : {20.0, 29.5}) block = joined(block, reversed(test::box({x, 25, 25}, {x + 9, 35, 35})));
  const Attempt given = [&] {
    const SolidMesh solid = test::solid_of(block);
    const SolidVolume volume = voxelize(solid, {.wall_mm = 2, .voxel_mm = 1}).value();
    const JointProblem joint = joint_problem(block, std::vector{Pose{}}, RowKind::nominal).value();
    Carving carving = carve(volume, solid.moments(), joint.problem, {.aim = CarveAim::stable}).value();
    Shell shell = build_shell(solid, VoidField{}, {.wall_mm = 2}).value();
    return Attempt{joint, std::move(carving), std::move(shell), volume};
  }();
  ASSERT_NEAR(least_wall_between_voids_mm(given), 0.5, 1e-3);
  const CarveAgain never = [](const SolidVolume&, const Job&) -> Result<Attempt> {
    return fail(ErrorCode::internal, "carved again");
  };
  const auto shaped = with_printable_ceilings(given, Rules(Process::fdm), never);
  ASSERT_TRUE(shaped.has_value()) << shaped.error().message;
  EXPECT_EQ(shaped->ceiling->left, 0u);
  EXPECT_EQ(shaped->shell->mesh, given.shell->mesh);
}

TEST(Ceilings, are_cancelled_at_every_report) {
  const Input input = input_of(test::box({0, 0, 0}, {24, 24, 24}));
  StandOptions options = options_of(Ceiling::automatic);
  options.voxel_mm = 1;
  test::CancelAt never(1 << 30);
  ASSERT_TRUE(stand(input, options, never.job()).has_value());
  for (int k = 1; k <= never.reports(); k += 1 + never.reports() / 40) {
    test::CancelAt at_k(k);
    const auto result = stand(input, options, at_k.job());
    ASSERT_FALSE(result.has_value()) << "at report " << k;
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace aplomb
