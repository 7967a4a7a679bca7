#include "aplomb/deform/regions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aplomb/balance/standing_rows.h"
#include "aplomb/deform/bend.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb::test {
namespace {

constexpr double degree = M_PI / 180;

/// A column of many triangles that stands, whatever is done to its top.
class Column : public testing::Test {
 protected:
  static TriangleMesh column() {
    std::vector<Vec2> profile{{0, 0}};
    for (int ring = 0; ring <= 40; ++ring) profile.push_back({10, 2.0 * ring});
    profile.push_back({0, 80});
    return lathe(profile, 48);
  }

  Result<Bent> bent(const Regions& regions) const {
    const StandingPose pose;
    const auto support = support_polygon(solid.mesh(), pose);
    EXPECT_TRUE(support);
    const BendProblem problem{standing_rows(*support, pose, RowKind::nominal),
                              vertices_near_plate(solid.mesh(), pose.up, pose.contact_height_mm),
                              {},
                              {{pose.up, support->frame.plate_mm}},
                              regions};
    const auto bender = Bender::make(solid, problem, {.wall_mm = 50, .samples = 20000});
    if (!bender) return tl::unexpected(bender.error());
    return bender->bend(-1, {});
  }

  /// The vertices of the surface within a ball, before and after.
  struct Part {
    std::vector<Vec3> from, to;
  };
  Part part_in(const Bent& bent, const BallRegion& ball) const {
    Part part;
    for (std::size_t v = 0; v < solid.mesh().vertices.size(); ++v)
      if (norm(solid.mesh().vertices[v] - ball.center_mm) <= ball.radius_mm) {
        part.from.push_back(solid.mesh().vertices[v]);
        part.to.push_back(bent.solid.mesh().vertices[v]);
      }
    EXPECT_GT(part.from.size(), 100u);
    return part;
  }

  /// The farthest that a point of the part is from where the map has it, all moved by the same vector.
  static double misfit_mm(const Part& part, const Mat3& wanted) {
    Vec3 mean;
    for (std::size_t v = 0; v < part.from.size(); ++v)
      mean += (part.to[v] - wanted * part.from[v]) / static_cast<double>(part.from.size());
    double worst = 0;
    for (std::size_t v = 0; v < part.from.size(); ++v)
      worst = std::max(worst, norm(part.to[v] - wanted * part.from[v] - mean));
    return worst;
  }

  const SolidMesh solid = solid_of(column());
  const BallRegion top{{0, 0, 72}, 14};
};

TEST_F(Column, IsLeftAloneWithoutAHandle) {
  const auto result = bent({});
  ASSERT_TRUE(result);
  EXPECT_LT(result->max_mm, 1e-6);
}

TEST_F(Column, IsPulledToAPoint) {
  const auto result = bent({.handles = {{.at = top, .to_mm = Vec3{6, -3, 70}}}});
  ASSERT_TRUE(result);
  EXPECT_LT(result->handle_short_mm, 0.15);
  for (const Part part = part_in(*result, top); const Vec3& p : part.from) {
    const Vec3 moved = part.to[static_cast<std::size_t>(&p - part.from.data())];
    EXPECT_LT(norm(moved - p - Vec3{6, -3, -2}), 0.3);
  }
}

TEST_F(Column, IsPulledAtAPointOfItsSurface) {
  const auto result = bent({.handles = {{.at = {{10, 0, 80}, 0}, .to_mm = Vec3{14, 0, 80}}}});
  ASSERT_TRUE(result);
  EXPECT_LT(result->handle_short_mm, 0.15);
  const auto &from = solid.mesh().vertices, &to = result->solid.mesh().vertices;
  for (std::size_t v = 0; v < from.size(); ++v)
    if (norm(from[v] - Vec3{10, 0, 80}) < 1e-4) {
      EXPECT_LT(norm(to[v] - Vec3{14, 0, 80}), 0.3);
    }
}

TEST_F(Column, HasItsTopTurned) {
  const AxisTurn turn{{0, 1, 0}, 25 * degree};
  const auto result = bent({.handles = {{.at = top, .turns = {turn}}}});
  ASSERT_TRUE(result);
  EXPECT_LT(misfit_mm(part_in(*result, top), rotation_of(turn)), 0.5);
  EXPECT_GT(misfit_mm(part_in(*result, top), {}), 3);
  EXPECT_NEAR(result->solid.moments().volume_mm3 / solid.moments().volume_mm3, 1, 0.02);
}

TEST_F(Column, HasItsTopScaled) {
  const auto result = bent({.handles = {{.at = top, .scale_ratio = 1.3}}});
  ASSERT_TRUE(result);
  EXPECT_LT(misfit_mm(part_in(*result, top), 1.3 * Mat3{}), 0.5);
  EXPECT_GT(misfit_mm(part_in(*result, top), {}), 2);
}

TEST_F(Column, StaysWhereItIsLocked) {
  const BallRegion middle{{0, 0, 32}, 14};
  const auto result = bent({.handles = {{.at = top, .to_mm = Vec3{6, 0, 72}}}, .locked = {middle}});
  ASSERT_TRUE(result);
  EXPECT_LT(result->handle_short_mm, 0.5);
  const Part part = part_in(*result, middle);
  EXPECT_EQ(part.to, part.from);
}

TEST_F(Column, BendsLessWhereItIsStiff) {
  const BallRegion lower{{0, 0, 20}, 24};
  const Regions pulled{.handles = {{.at = top, .to_mm = Vec3{6, 0, 72}}}};
  Regions stiff = pulled;
  stiff.stiffened = {{lower, 30}};
  const auto freely = bent(pulled), stiffly = bent(stiff);
  ASSERT_TRUE(freely && stiffly);
  const BallRegion low{{0, 0, 15}, 15};
  EXPECT_LT(misfit_mm(part_in(*stiffly, low), {}), 0.3 * misfit_mm(part_in(*freely, low), {}));
}

TEST_F(Column, IsNotToBeMovedWhereThereIsNothingOfIt) {
  for (const Regions& regions :
       {Regions{.handles = {{.at = {{0, 0, 200}, 5}, .scale_ratio = 2}}}, Regions{.kept = {{{0, 0, 200}, 5}}},
        Regions{.locked = {{{50, 0, 20}, 0}}}, Regions{.stiffened = {{{{0, 0, 200}, 5}, 3}}}}) {
    const auto result = bent(regions);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::invalid_option);
    EXPECT_NE(result.error().message.find("holds nothing of the model"), std::string::npos) << result.error().message;
  }
}

TEST(Regions, SayWhichNumberIsOutOfRange) {
  EXPECT_EQ(find_problem(Regions{.kept = {{{}, -1}}}), "radius_mm of a region is -1; it must be at least 0");
  EXPECT_EQ(find_problem(Regions{.handles = {{.at = {}, .scale_ratio = 0.1}}}),
            "scale_ratio of a handle is 0.1; it must lie in [0.2, 5]");
  EXPECT_EQ(find_problem(Regions{.stiffened = {{{}, 0}}}),
            "ratio of a stiff region is 0; it must lie in [0.001, 1000]");
  EXPECT_EQ(find_problem(Regions{}), "");
}

}  // namespace
}  // namespace aplomb::test
