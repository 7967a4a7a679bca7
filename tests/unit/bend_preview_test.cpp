#include "aplomb/deform/bend_preview.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aplomb/balance/stability.h"
#include "support/solids.h"

namespace aplomb::test {
namespace {

constexpr double degree = M_PI / 180;

/// A round column of many triangles, 60 mm high, that leans by `lean` millimetres for each of its height.
SolidMesh column(double lean) {
  std::vector<Vec2> profile{{0, 0}};
  for (int ring = 0; ring <= 40; ++ring) profile.push_back({8, 1.5 * ring});
  profile.push_back({0, 60});
  TriangleMesh mesh = lathe(profile, 48);
  for (Vec3& v : mesh.vertices) v.x += lean * v.z;
  return solid_of(mesh);
}

std::vector<Pose> standing(double tip_deg) {
  Pose pose;
  pose.way = StandingPose{.required_tip_rad = tip_deg * degree};
  return {pose};
}

BendPreview preview_of(const SolidMesh& solid, double tip_deg, double most_mean_percent = 20) {
  auto made = BendPreview::make(solid, standing(tip_deg),
                                {.reshape = {.most_mean_percent = most_mean_percent, .wall_mm = 3}, .samples = 8000});
  EXPECT_TRUE(made) << made.error().message;
  return std::move(*made);
}

/// Stage after stage, until it has settled.
BendStage settled(const BendPreview& preview, const BendWish& wish, std::vector<Vec3> from = {}) {
  for (int n = 0; n < 60; ++n) {
    auto stage = preview.advance(wish, from);
    EXPECT_TRUE(stage) << stage.error().message;
    if (stage->settled) return std::move(*stage);
    from = std::move(stage->cage);
  }
  ADD_FAILURE() << "it never settles";
  return {};
}

double farthest_mm(const TriangleMesh& a, const TriangleMesh& b) {
  double farthest = 0;
  for (std::size_t v = 0; v < a.vertices.size(); ++v)
    farthest = std::max(farthest, norm(a.vertices[v] - b.vertices[v]));
  return farthest;
}

Handle top_handle(Vec3 by_mm) { return {{{0, 0, 58}, 6}, Vec3{0, 0, 58} + by_mm}; }

TEST(BendPreview, ComesToWhatTheWholeSearchFindsInThatCage) {
  const SolidMesh solid = column(0.3);
  const auto joint = joint_problem(solid.mesh(), standing(8), RowKind::nominal);
  const auto cage = build_cage(solid, {.wall_mm = 3, .samples = 8000});
  ASSERT_TRUE(joint && cage);
  CageProblem problem = cage_problem(*cage, solid, bend_problem(solid, standing(8), joint->problem, {}));
  problem.required_t = joint->required_t;
  const auto whole = deform_cage(problem, {.most_mean_mm = 12});
  ASSERT_TRUE(whole);
  ASSERT_EQ(whole->outcome, DeformOutcome::reached);
  const BendStage stage = settled(preview_of(solid, 8), {});
  ASSERT_EQ(stage.cage.size(), whole->vertices.size());
  double farthest = 0;
  for (std::size_t v = 0; v < stage.cage.size(); ++v)
    farthest = std::max(farthest, norm(stage.cage[v] - whole->vertices[v]));
  EXPECT_LT(farthest, 0.2);
  EXPECT_GT(whole->max_mm, 2);
  EXPECT_NEAR(stage.t, whole->t, 0.002);
}

TEST(BendPreview, FollowsAHandleFromWhereItIs) {
  const BendPreview preview = preview_of(column(0), 1);
  const BendStage first = settled(preview, {.regions = {.handles = {top_handle({4, 0, 0})}}, .balances = false});
  EXPECT_LT(first.handle_short_mm, 0.3);
  EXPECT_GT(first.max_mm, 3.5);
  const BendWish further{.regions = {.handles = {top_handle({4, 3, 0})}}, .balances = false};
  const BendStage from_first = settled(preview, further, first.cage), from_rest = settled(preview, further);
  EXPECT_LT(farthest_mm(from_first.surface, from_rest.surface), 0.3);
  EXPECT_GT(farthest_mm(from_first.surface, first.surface), 2);
}

TEST(BendPreview, HoldsWhatThePosesHoldAndWhatIsLocked) {
  const SolidMesh solid = column(0);
  const BendWish wish{.regions = {.handles = {top_handle({5, 0, -3})}, .locked = {{{0, 0, 25}, 12}}},
                      .balances = false};
  const BendStage stage = settled(preview_of(solid, 1), wish);
  std::size_t held = 0;
  for (std::size_t v = 0; v < solid.mesh().vertices.size(); ++v) {
    const Vec3 rest = solid.mesh().vertices[v];
    EXPECT_GE(stage.surface.vertices[v].z, 0);
    if (rest.z > 0.1 && norm(rest - Vec3{0, 0, 25}) > 10) continue;
    EXPECT_EQ(stage.surface.vertices[v], rest);
    ++held;
  }
  EXPECT_GT(held, 100U);
}

TEST(BendPreview, BeginsAtRestWhereWhatHasMovedIsLocked) {
  const SolidMesh solid = column(0);
  const BendPreview preview = preview_of(solid, 1);
  const BendStage bent = settled(preview, {.regions = {.handles = {top_handle({5, 0, 0})}}, .balances = false});
  const BendStage locked = settled(preview, {.regions = {.locked = {{{0, 0, 58}, 6}}}, .balances = false}, bent.cage);
  EXPECT_LT(farthest_mm(locked.surface, solid.mesh()), 1e-6);
}

TEST(BendPreview, WithinALimitItStillFollowsWhereAHandleGoes) {
  const BendPreview preview = preview_of(column(0), 1, 2);
  const auto pulled = [&](Vec3 by_mm, const std::vector<Vec3>& from) {
    return settled(preview, {.regions = {.handles = {top_handle(by_mm)}}, .balances = false}, from);
  };
  const BendStage right = pulled({12, 0, 0}, {}), back = pulled({0, 12, 0}, right.cage);
  EXPECT_LT(farthest_mm(back.surface, pulled({0, 12, 0}, {}).surface), 0.5);
  EXPECT_GT(farthest_mm(back.surface, right.surface), 1);
}

TEST(BendPreview, StopsWhenAskedTo) {
  const auto stage = preview_of(column(0.3), 8).advance({}, {}, Job([](double, std::string_view) { return false; }));
  ASSERT_FALSE(stage);
  EXPECT_EQ(stage.error().code, ErrorCode::cancelled);
}

TEST(BendPreview, GivesTheSameBytesTwice) {
  const BendPreview preview = preview_of(column(0.3), 8);
  EXPECT_EQ(settled(preview, {}).surface, settled(preview, {}).surface);
}

}  // namespace
}  // namespace aplomb::test
