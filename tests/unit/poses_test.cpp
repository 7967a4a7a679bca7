#include "aplomb/balance/poses.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "aplomb/balance/hanging_rows.h"
#include "aplomb/pipeline.h"
#include "aplomb/report/json.h"
#include "aplomb/report/text.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double infinity = std::numeric_limits<double>::infinity();

Pose standing_on(Vec3 down, double tip_deg, std::string name = "") {
  return {std::move(name), StandingPose{.up = -down, .required_tip_rad = tip_deg * degree}};
}

Pose hanging_from(std::vector<Vec3> points, double tilt_deg, std::string name = "") {
  return {std::move(name), HangingPose{.attachments_mm = std::move(points), .required_tilt_rad = tilt_deg * degree}};
}

Hanging hanging_of(Vec3 com_mm, const Pose& pose) {
  const Region body{Moments{5, 5.0 * com_mm}, 2};
  return measure_hanging({&body, 1}, *pose.hanging());
}

Input input_of(const TriangleMesh& mesh) {
  const SolidMesh solid = test::solid_of(mesh);
  return {solid, solid.moments(), {}, {}, {}};
}

TEST(Hanging, TurnsTheCentreOfMassStraightBelowThePoint) {
  const Pose pose = hanging_from({{1, 2, 10}}, 2);
  const Hanging h = hanging_of({1 + 3, 2, 10 - 4}, pose);
  EXPECT_NEAR(h.tilt_rad, std::atan2(3, 4), 1e-14);
  EXPECT_NEAR(h.drop_mm, 4, 1e-14);
  EXPECT_NEAR(h.mass_g, 0.01, 1e-15);
  EXPECT_GT(hanging_of({1 + 3, 2, 10 + 4}, pose).tilt_rad, std::numbers::pi / 2);
}

TEST(Hanging, FromTwoPointsTurnsAboutTheirAxisAndNeedsTheCentreOfMassBetween) {
  const Pose pose = hanging_from({{0, 0, 10}, {8, 0, 12}}, 2);
  const Hanging h = hanging_of({4, 1.5, 6}, pose);
  EXPECT_NEAR(h.tilt_rad, std::atan2(1.5, 5), 1e-14);
  EXPECT_TRUE(h.pulls_all_threads);
  EXPECT_FALSE(hanging_of({9, 0, 6}, pose).pulls_all_threads);
  EXPECT_FALSE(holds(pose, hanging_of({9, 0, 6}, pose), RowKind::nominal));
}

TEST(Hanging, HoldsExactlyWhereItsRowsGrantTheTiltOrATadMore) {
  for (const auto& points : {std::vector<Vec3>{{0, 0, 10}}, std::vector<Vec3>{{-9, 0, 10}, {9, 0, 10}}})
    for (int turn = 0; turn < 40; ++turn)
      for (const double out : {0.5, 0.97, 1.03, 2.0}) {
        const Pose pose = hanging_from(points, 5);
        const double angle = turn * 0.157, reach = out * 6 * std::tan(5 * degree);
        const Vec3 com{points.size() == 2 ? 0 : reach * std::cos(angle),
                       points.size() == 2 ? reach : reach * std::sin(angle), 4};
        const Moments body{1, com};
        const JointProblem joint = joint_problem({}, {&pose, 1}, RowKind::nominal).value();
        const bool granted = largest_t(joint.problem, body) >= joint.required_t;
        const bool does = holds(pose, hanging_of(com, pose), RowKind::nominal);
        EXPECT_EQ(does, out < 1);
        EXPECT_TRUE(!granted || does);
        EXPECT_TRUE(granted == does || out == 0.97);
      }
}

TEST(HangingRows, RefuseABodyWhoseCentreOfMassIsNotBelowThePoint) {
  const Pose pose = hanging_from({{0, 0, 10}}, 5);
  const JointProblem joint = joint_problem({}, {&pose, 1}, RowKind::nominal).value();
  EXPECT_EQ(largest_t(joint.problem, Moments{1, {0, 0, 9.5}}), -infinity);  // 1 mm is asked for
  EXPECT_EQ(largest_t(joint.problem, Moments{1, {0, 0, 12}}), -infinity);
  EXPECT_NEAR(largest_t(joint.problem, Moments{1, {0, 0, 8}}), 0, 1e-15);
}

TEST(JointProblem, OfABoxOnTwoFacesFollowsTheClosedForm) {
  const Vec3 size{20, 30, 50};
  const TriangleMesh box = test::box({}, size);
  const std::vector<Pose> poses{standing_on({0, 0, -1}, 10), standing_on({-1, 0, 0}, 40)};
  const JointProblem joint = joint_problem(box, poses, RowKind::nominal).value();
  EXPECT_EQ(joint.bound_of, BoundOf::surplus);
  EXPECT_EQ(joint.required_t, 0);
  const double on_end = (size.x / 2) / (size.z / 2) - std::tan(10 * degree);
  const double on_side = (size.y / 2) / (size.x / 2) - std::tan(40 * degree);
  EXPECT_NEAR(largest_t(joint.problem, moments(box)), std::min(on_end, on_side), 1e-12);
}

TEST(JointProblem, IsExceededByNoMeasuredSurplusButForWhatTheDirectionsOfThreadsOverlook) {
  const std::vector<Pose> poses{hanging_from({{0, 0, 10}}, 50), hanging_from({{1, 0, 12}}, 60)};
  const JointProblem joint = joint_problem({}, poses, RowKind::nominal).value();
  int overlooked = 0;
  for (int turn = 0; turn < 40; ++turn) {
    const Vec3 com{3 * std::cos(0.157 * turn), 3 * std::sin(0.157 * turn), 4};
    double surplus = infinity;
    for (const Pose& pose : poses)
      surplus = std::min(surplus, surplus_t(pose, hanging_of(com, pose), RowKind::nominal));
    const double t = largest_t(joint.problem, {1, com});
    EXPECT_LE(surplus, t + joint.overlooked_t + 1e-12);
    overlooked += surplus > t + 1e-6;
  }
  EXPECT_GT(overlooked, 0);
}

TEST(JointProblem, TellsTheAngleOfEachPoseAtItsT) {
  const TriangleMesh box = test::box({}, {20, 30, 50});
  const std::vector<Pose> poses{standing_on({0, 0, -1}, 10), standing_on({-1, 0, 0}, 40),
                                hanging_from({{0, 15, 50}, {20, 15, 50}}, 30)};
  const JointProblem joint = joint_problem(box, poses, RowKind::nominal).value();
  for (const Vec3 com : {Vec3{10, 15, 25}, Vec3{4, 15, 25}, Vec3{10, 3, 25}, Vec3{10, 15, 46}}) {
    const double t = largest_t(joint.problem, Moments{1, com});
    const Region body{Moments{5, 5.0 * com}, 2};
    double closest = infinity;
    for (const Pose& pose : poses) {
      const auto measure = measure_pose(box, {&body, 1}, pose).value();
      const double spare = pose.hanging()
                               ? angle_at_rad(pose, joint, t) - std::get<Hanging>(measure).tilt_rad
                               : std::get<Standing>(measure).stability.tip_rad - angle_at_rad(pose, joint, t);
      EXPECT_GE(spare, -1e-12);
      closest = std::min(closest, spare);
    }
    EXPECT_NEAR(closest, 0, 1e-12);
  }
}

TEST(JointProblem, OfOnePoseKeepsItsOwnAngle) {
  const TriangleMesh box = test::box({}, {20, 30, 50});
  const Pose pose = standing_on({0, 0, -1}, 10);
  const JointProblem joint = joint_problem(box, {&pose, 1}, RowKind::nominal).value();
  EXPECT_EQ(joint.bound_of, BoundOf::tip);
  EXPECT_EQ(joint.required_t, std::tan(10 * degree));
  EXPECT_NEAR(std::atan(largest_t(joint.problem, moments(box))), std::atan2(10, 25), 1e-14);
  EXPECT_EQ(angle_at_rad(pose, joint, 0.5), std::atan(0.5));
}

TEST(Poses, AreRefusedFieldByField) {
  const auto problem = [](Pose pose) { return find_problem(std::span(&pose, 1)); };
  EXPECT_EQ(problem({}), "");
  EXPECT_EQ(problem(hanging_from({{1, 2, 3}}, 2)), "");
  EXPECT_NE(find_problem(std::span<const Pose>()), "");
  EXPECT_NE(problem(hanging_from({}, 2)).find("number of points"), std::string::npos);
  EXPECT_NE(problem(hanging_from({{0, 0, 0}, {0, 0, 5}}, 2)).find("above the other"), std::string::npos);
  EXPECT_NE(problem(hanging_from({{0, 0, std::nan("")}}, 2)).find("not a number"), std::string::npos);
  for (const double bad : {0.0, 90.0, -3.0, std::nan("")})
    EXPECT_NE(problem(hanging_from({{1, 2, 3}}, bad)).find("required_tilt_rad"), std::string::npos);
  Pose near = hanging_from({{1, 2, 3}}, 2, "hook");
  std::get<HangingPose>(near.way).least_drop_mm = 0;
  EXPECT_EQ(problem(near).rfind("pose hook: least_drop_mm", 0), 0u);
  std::get<HangingPose>(near.way).up = {0, 0, 2};
  EXPECT_NE(problem(near).find("length of up"), std::string::npos);
}

/// A beam that hangs from a point off its middle is carved until the final mesh, not a stage, hangs level.
TEST(StandRun, MakesABeamHangLevelByItsFinalMesh) {
  const Input input = input_of(test::box({0, 0, 0}, {40, 16, 12}));
  StandOptions options{.poses = {hanging_from({{21, 8, 12}}, 2)}, .wall_mm = 1.6, .voxel_mm = 0.8};
  const StandRun run = stand(input, options).value();
  ASSERT_TRUE(run.shell);
  const Report report = measure_output(run.shell->mesh, input, run, options).value();
  EXPECT_EQ(report.outcome, Outcome::stands);
  const Vec3 com = moments(run.shell->mesh).centroid_mm();
  const double tilt = std::atan2(std::hypot(com.x - 21, com.y - 8), 12 - com.z);
  EXPECT_NEAR(std::get<Hanging>(report.poses[0].after.value()).tilt_rad, tilt, 1e-12);
  EXPECT_LE(tilt, 2 * degree);
  EXPECT_GT(tilt, 1.9 * degree);  // and no more than was asked
  EXPECT_NEAR(std::get<Hanging>(report.poses[0].before).tilt_rad, std::atan2(1, 6), 1e-9);
  EXPECT_TRUE(verdict(report).starts_with("Hangs level now: tilted by 2.0 degrees")) << verdict(report);
}

/// What helps on its feet (a low centre of mass, to one side) hurts on its head.
TEST(StandRun, MakesALeaningBlockStandOnBothItsFacesByItsFinalMesh) {
  const Input input = input_of(test::leaning_prism(30, 24, 40, 12));
  const std::array<double, 2> asked_deg{28, 15};
  StandOptions options{
      .poses = {standing_on({0, 0, -1}, asked_deg[0], "feet"), standing_on({0, 0, 1}, asked_deg[1], "head")},
      .wall_mm = 1.6,
      .voxel_mm = 0.8};
  const StandRun run = stand(input, options).value();
  ASSERT_TRUE(run.shell);
  const Report report = measure_output(run.shell->mesh, input, run, options).value();
  EXPECT_EQ(report.outcome, Outcome::stands);
  const Vec3 com = moments(run.shell->mesh).centroid_mm();
  for (const std::size_t i : {0u, 1u}) {  // the base is 30 x 24, around x = 0 below and 12 above
    const double drop = i == 0 ? com.z : 40 - com.z, aside = std::abs(com.x - (i == 0 ? 0 : 12));
    const double tip_rad = std::get<Standing>(report.poses[i].after.value()).stability.tip_rad;
    EXPECT_NEAR(tip_rad, std::atan2(std::min(15 - aside, 12 - std::abs(com.y)), drop), 5e-3);  // contacts are 0.1 high
    EXPECT_GE(tip_rad, asked_deg[i] * degree);
  }
  EXPECT_LT(std::get<Standing>(report.poses[0].before).stability.tip_rad, asked_deg[0] * degree);
  EXPECT_EQ(report.carving->bound_of, BoundOf::surplus);
  EXPECT_GT(report.carving->gap_rad, 0);
  EXPECT_EQ(report.before.stability.tip_rad, std::get<Standing>(report.poses[0].before).stability.tip_rad);
}

TEST(StandRun, FindsNoVoidThatHangsABeamFromItsBottomAndSaysSo) {
  const Input input = input_of(test::box({0, 0, 0}, {40, 16, 12}));
  StandOptions options{.poses = {hanging_from({{20, 8, 0}}, 2)}, .wall_mm = 1.6, .voxel_mm = 0.8, .best_effort = true};
  const StandRun run = stand(input, options).value();
  EXPECT_EQ(run.report.outcome, Outcome::best_effort);
  EXPECT_NEAR(run.report.carving->bound_rad, 90 * degree, 1e-12);
  EXPECT_TRUE(verdict(run.report).starts_with("Cannot hang level")) << verdict(run.report);
  ASSERT_TRUE(run.shell);
  EXPECT_FALSE(run.report.poses[0].holds);
}

TEST(PoseReport, ListsEveryPoseInJsonAndInText) {
  const Input input = input_of(test::box({0, 0, 0}, {40, 30, 60}));
  const StandOptions options{.poses = {hanging_from({{20, 15, 60}}, 2, "hook"), standing_on({0, 0, -1}, 10, "feet"),
                                       standing_on({-1, 0, 0}, 60)}};
  const Report report = check(input, options).value();
  EXPECT_EQ(report.outcome, Outcome::falls);
  const auto json = nlohmann::json::parse(to_json(report));
  ASSERT_EQ(json.at("poses").size(), 3u);
  EXPECT_EQ(json["poses"][0]["kind"], "hanging");
  EXPECT_EQ(json["poses"][0]["attachments_mm"][0], (std::vector<double>{20, 15, 60}));
  EXPECT_NEAR(json["poses"][0]["required_tilt_deg"].get<double>(), 2, 1e-12);
  EXPECT_NEAR(json["poses"][0]["before"]["drop_mm"].get<double>(), 30, 1e-12);
  EXPECT_EQ(json["poses"][1]["before"], json["before"]);
  EXPECT_EQ(json["poses"][1]["holds"], true);
  EXPECT_EQ(json["poses"][2]["name"], "pose 3");
  EXPECT_EQ(json["poses"][2]["holds"], false);
  EXPECT_EQ(verdict(report), "Does not hold all 3 poses: hook 0.0, feet 26.6, pose 3 36.9 (too little) degrees");
  for (const char* name : {"hook (hangs, to 2.0 degrees asked)", "feet (stands, 10.0", "pose 3 (stands, 60.0"})
    EXPECT_NE(to_text(report).find(name), std::string::npos) << name;
}

TEST(PoseReport, HasNoBeforeWhereNothingStands) {
  const Input input = input_of(test::box({0, 0, 0}, {40, 30, 60}));
  const Report report = check(input, {.poses = {hanging_from({{20, 15, 60}}, 2)}}).value();
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(report.outcome, Outcome::already_stands);
  for (const char* key : {"before", "after", "required_tip_deg"}) EXPECT_FALSE(json.contains(key)) << key;
  EXPECT_EQ(json["poses"].size(), 1u);
  EXPECT_EQ(verdict(report), "Hangs level: tilted by 0.0 degrees (2.0 asked)");
}

}  // namespace
}  // namespace aplomb
