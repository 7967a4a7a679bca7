#include "aplomb/inserted.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "aplomb/mesh/detail/topology.h"
#include "aplomb/pipeline.h"
#include "aplomb/shell/wall.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;

Input leaning(double lean_mm) {
  Input input{test::solid_of(test::leaning_prism(34, 40, 60, lean_mm)), {}, {}, {}, {}};
  input.moments = input.solid.moments();
  return input;
}

StandOptions options_for(double tip_deg, const std::vector<const char*>& inserts) {
  StandOptions options;
  options.voxel_mm = 0.8;
  std::get<StandingPose>(options.poses.front().way).required_tip_rad = tip_deg * degree;
  for (const char* text : inserts) options.inserts.push_back(parse_insert(text).value());
  return options;
}

Report measured(const StandRun& run, const Input& input, const StandOptions& options) {
  return measure_output(run.shell->mesh, input, run, options).value();
}

/// The tip angle of leaning(lean_mm) by levers: its base is 34 x 40 about the origin, and what is up to 0.1 mm above it
/// counts as contact.
double tip_of(const TriangleMesh& shell, const std::vector<PocketFigures>& inserts, double lean_mm) {
  const Moments body = moments(shell);
  double mass_g = 1.24e-3 * body.volume_mm3;
  Vec3 moment = 1.24e-3 * body.first_mm4;
  for (const PocketFigures& pocket : inserts) mass_g += pocket.mass_g, moment += pocket.mass_g * pocket.at_mm;
  const Vec3 com = moment / mass_g;
  return std::atan(std::min(17 + 0.1 * lean_mm / 60 - com.x, 20 - std::abs(com.y)) / com.z);
}

/// Each closed surface of a shell.
std::vector<TriangleMesh> surfaces_of(const TriangleMesh& shell) {
  const auto parts = detail::edge_components(shell, detail::EdgeTable(shell));
  std::vector<TriangleMesh> surfaces;
  for (std::uint32_t part = 0; part < parts.count; ++part)
    surfaces.push_back(detail::submesh(shell, [&](std::size_t t) { return parts.of_triangle[t] == part; }));
  return surfaces;
}

void expect_walls(const TriangleMesh& shell, double wall_mm) {
  const auto surfaces = surfaces_of(shell);
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(measure_wall(surfaces[i], surfaces[j], wall_mm)->least_mm, wall_mm * (1 - 2e-4));
}

TEST(Inserted, AloneMakeABlockStandWithAsFewAsItTakes) {
  const Input input = leaning(26);
  const StandOptions options = options_for(10.5, {"ball:10mm:8"});
  const StandRun run = stand(input, options).value();
  ASSERT_TRUE(run.report.inserts && run.shell);
  EXPECT_FALSE(run.carving);
  const Report report = measured(run, input, options);
  EXPECT_EQ(report.outcome, Outcome::stands);
  EXPECT_LT(report.before.stability.tip_rad, 10.5 * degree);
  EXPECT_GE(report.after->stability.tip_rad, 10.5 * degree);
  EXPECT_NEAR(report.after->stability.tip_rad, tip_of(run.shell->mesh, report.inserts->pockets, 26), 1e-6);
  EXPECT_NEAR(report.inserts->reached_rad, report.after->stability.tip_rad, 1e-9);
  EXPECT_GE(report.inserts->bound_rad, report.inserts->reached_rad - 1e-9);
  const int used = report.inserts->count();
  ASSERT_GT(used, 1);
  const StandOptions fewer = options_for(10.5, {("ball:10mm:" + std::to_string(used - 1)).c_str()});
  EXPECT_TRUE(stand(input, fewer)->carving) << "fewer would have done";
  expect_walls(run.shell->mesh, options.wall_mm);
  EXPECT_GE(report.wall->measured_mm, options.wall_mm - 1e-5);
}

TEST(Inserted, LeaveTheOutsideAsItCameAndPrint) {
  const Input input = leaning(26);
  const StandOptions options = options_for(10.5, {"ball:10mm:3", "penny:3"});
  const StandRun run = stand(input, options).value();
  ASSERT_TRUE(run.shell);
  const TriangleMesh& outer = input.solid.mesh();
  ASSERT_GT(run.shell->mesh.triangles.size(), outer.triangles.size());
  for (std::size_t t = 0; t < outer.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(run.shell->mesh.vertices[run.shell->mesh.triangles[t][corner]],
                outer.vertices[outer.triangles[t][corner]]);
  const Report report = measured(run, input, options);
  EXPECT_TRUE(report.mesh->outer_unchanged);
  EXPECT_EQ(report.mesh->voids, report.inserts->pockets.size());
  EXPECT_TRUE(report.judgement->passes());
  for (const Finding& finding : report.judgement->findings) EXPECT_NE(finding.id, "void.closed");
}

TEST(Inserted, GoTogetherWithAVoidWhereTheyDoNotDoAlone) {
  const Input input = leaning(33);
  const StandOptions options = options_for(10, {"penny:2"}), bare = options_for(10, {});
  const StandRun run = stand(input, options).value(), without = stand(input, bare).value();
  ASSERT_TRUE(run.carving && run.shell && without.carving);
  EXPECT_EQ(run.report.outcome, Outcome::stands);
  const Report report = measured(run, input, options);
  EXPECT_GE(report.after->stability.tip_rad, 10 * degree);
  EXPECT_NEAR(report.after->stability.tip_rad, tip_of(run.shell->mesh, report.inserts->pockets, 33), 1e-6);
  EXPECT_LT(report.inserts->reached_rad, 10 * degree);
  EXPECT_EQ(report.inserts->count(), 2);
  EXPECT_GT(report.carving->void_mm3, 0);
  EXPECT_LT(report.carving->void_mm3, without.report.carving->void_mm3);  // coins save some of it
  EXPECT_GT(report.carving->bound_rad, without.report.carving->bound_rad);
  expect_walls(run.shell->mesh, options.wall_mm);
}

TEST(Inserted, AreAllUsedForTheLargestAngle) {
  const Input input = leaning(20);
  StandOptions options = options_for(5, {"ball:8mm:3"});
  options.aim = CarveAim::stable;
  options.ceiling = Ceiling::any;
  const StandRun run = stand(input, options).value();
  ASSERT_TRUE(run.report.inserts);
  EXPECT_EQ(run.report.inserts->count(), 3);
  StandOptions bare = options;
  bare.inserts.clear();
  EXPECT_GT(measured(run, input, options).after->stability.tip_rad,
            measured(*stand(input, bare), input, bare).after->stability.tip_rad);
}

TEST(Inserted, HoldTheRobustAngleWithErrorsOfTheirMass) {
  const Input input = leaning(26);
  StandOptions options = options_for(9, {"ball:10mm:8"});
  options.robust = true;
  const StandRun run = stand(input, options).value();
  const Report report = measured(run, input, options);
  EXPECT_EQ(report.outcome, Outcome::stands);
  EXPECT_GE(report.after->stability.robust_tip_rad, 9 * degree - 1e-9);
  EXPECT_GT(report.after->stability.tip_rad, report.after->stability.robust_tip_rad + 0.1 * degree);
}

TEST(Inserted, AreWeighedBesideASparseFilling) {
  const Input input = leaning(26);
  StandOptions options = options_for(12, {"ball:10mm:9"});
  options.profile = PrintProfile{};
  options.profile->layer_mm = options.profile->first_layer_mm = 0.25;
  const StandRun run = stand(input, options).value();
  const Report report = measured(run, input, options);
  EXPECT_EQ(report.outcome, Outcome::stands);
  EXPECT_GE(report.after->stability.tip_rad, 12 * degree);
  EXPECT_EQ(report.inserts->layer_mm, 0.25);
  for (const PocketFigures& pocket : report.inserts->pockets)
    EXPECT_NEAR(std::remainder(pocket.pause_mm, 0.25), 0, 1e-6);
}

TEST(Inserted, HelpASolidHangLevel) {
  Input input = leaning(0.001);
  StandOptions options = options_for(10, {"ball:10mm:4"});
  HangingPose hanging;
  hanging.attachments_mm = {{3, 0, 60}};
  hanging.required_tilt_rad = 3 * degree;
  options.poses = {Pose{"hook", hanging}};
  const StandRun run = stand(input, options).value();
  const Report report = measured(run, input, options);
  EXPECT_EQ(report.outcome, Outcome::stands);
  const Hanging &before = std::get<Hanging>(report.poses[0].before), &after = std::get<Hanging>(*report.poses[0].after);
  EXPECT_GT(before.tilt_rad, 3 * degree);
  EXPECT_LE(after.tilt_rad, 3 * degree);
}

TEST(Inserted, ArePutNowhereWhereItStandsAlready) {
  const Input input = leaning(1);
  const StandRun run = stand(input, options_for(5, {"penny:2"})).value();
  EXPECT_EQ(run.report.outcome, Outcome::already_stands);
  EXPECT_FALSE(run.report.inserts);
  EXPECT_EQ(run.shell->mesh, input.solid.mesh());
}

TEST(Inserted, SayWhyTheyCannotBe) {
  const Input input = leaning(33);
  const auto big = stand(input, options_for(10, {"coin:38x3mm"}));
  ASSERT_FALSE(big);
  EXPECT_EQ(big.error().code, ErrorCode::unusable_input);
  EXPECT_NE(big.error().message.find("no place for a coin 38 x 3 mm"), std::string::npos) << big.error().message;
  EXPECT_NE(big.error().message.find("mm across"), std::string::npos);
  StandOptions bent = options_for(10, {"penny"}), resin = bent;
  bent.deform = Deform::automatic;
  resin.judge.rules = Rules(Process::sla);
  for (const StandOptions& options : {bent, resin}) {
    const auto refused = stand(input, options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_option) << refused.error().message;
  }
}

TEST(Inserted, GiveTheSameBytesTwice) {
  const Input input = leaning(26);
  const StandOptions options = options_for(10.5, {"ball:10mm:4", "penny:4"});
  EXPECT_EQ(stand(input, options)->shell->mesh, stand(input, options)->shell->mesh);
}

}  // namespace
}  // namespace aplomb
