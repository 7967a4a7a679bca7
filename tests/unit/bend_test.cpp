#include "aplomb/deform/bend.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aplomb/balance/standing.h"
#include "aplomb/balance/standing_rows.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb::test {
namespace {

constexpr double degree = M_PI / 180;

/// A column of many triangles that leans so far that it falls.
SolidMesh leaning_column() {
  std::vector<Vec2> profile{{0, 0}};
  for (int ring = 0; ring <= 40; ++ring) profile.push_back({8, 1.5 * ring});
  profile.push_back({0, 60});
  TriangleMesh column = lathe(profile, 48);
  for (Vec3& v : column.vertices) v.x += 0.3 * v.z;
  return solid_of(column);
}

BendProblem problem_of(const SolidMesh& solid, const StandingPose& pose) {
  const auto support = support_polygon(solid.mesh(), pose);
  EXPECT_TRUE(support);
  return {standing_rows(*support, pose, RowKind::nominal),
          vertices_near_plate(solid.mesh(), pose.up, pose.contact_height_mm),
          {},
          {{pose.up, support->frame.plate_mm}},
          {}};
}

/// Not to be carved at all.
constexpr CageOptions solid_through{.wall_mm = 50, .samples = 20000};

double tip_deg(const SolidMesh& solid) {
  const std::array body{Region{solid.moments(), 1, 0}};
  return measure_standing(solid.mesh(), body, {})->stability.tip_rad / degree;
}

Bent bent(const SolidMesh& solid, const BendProblem& problem, double tip_deg, const DeformOptions& options = {}) {
  const auto bender = Bender::make(solid, problem, solid_through);
  EXPECT_TRUE(bender) << bender.error().message;
  auto result = bender->bend(std::tan(tip_deg * degree), options);
  EXPECT_TRUE(result) << result.error().message;
  return std::move(*result);
}

TEST(Bend, MakesALeaningColumnStandAsFarAsAsked) {
  const SolidMesh column = leaning_column();
  ASSERT_LT(tip_deg(column), -1);
  const Bent result = bent(column, problem_of(column, {}), 5);
  EXPECT_EQ(result.cage.outcome, DeformOutcome::reached);
  EXPECT_EQ(result.path_ratio, 1);
  EXPECT_NEAR(tip_deg(result.solid), 5, 0.25);
  EXPECT_GT(result.mean_mm, 0);
  EXPECT_LT(result.max_mm, 10);
}

TEST(Bend, LeavesContactsTrianglesAndThePlateAlone) {
  const SolidMesh column = leaning_column();
  const BendProblem problem = problem_of(column, {});
  const Bent result = bent(column, problem, 5);
  EXPECT_EQ(result.solid.mesh().triangles, column.mesh().triangles);
  for (std::size_t v = 0; v < problem.held.size(); ++v) {
    EXPECT_GE(result.solid.mesh().vertices[v].z, 0);
    if (problem.held[v]) {
      EXPECT_EQ(result.solid.mesh().vertices[v], column.mesh().vertices[v]);
    }
  }
}

TEST(Bend, StaysWithinTheMeanDisplacementAllowed) {
  const SolidMesh column = leaning_column();
  DeformOptions options;
  options.most_mean_mm = 1;
  const Bent result = bent(column, problem_of(column, {}), 20, options);
  EXPECT_EQ(result.cage.outcome, DeformOutcome::limit);
  EXPECT_LE(result.cage.mean_mm, 1 + 1e-9);
  EXPECT_GT(tip_deg(result.solid), tip_deg(column) + 0.5);
}

TEST(Bend, KeepsTheShapeOfABallThatIsToBeKept) {
  const SolidMesh column = leaning_column();
  BendProblem problem = problem_of(column, {});
  const Vec3 middle{0.3 * 50, 0, 50};
  const auto worst_stretch = [&](const Bent& result) {
    double worst = 0;
    const auto &from = column.mesh().vertices, &to = result.solid.mesh().vertices;
    for (const Triangle& t : column.mesh().triangles)
      if (norm(from[t[0]] - middle) < 9 && norm(from[t[1]] - middle) < 9) {
        const double was = norm(from[t[1]] - from[t[0]]), is = norm(to[t[1]] - to[t[0]]);
        worst = std::max(worst, std::abs(is / was - 1));
      }
    return worst;
  };
  const double freely = worst_stretch(bent(column, problem, 5));
  problem.regions.kept = {{middle, 12}};
  const double kept = worst_stretch(bent(column, problem, 5));
  EXPECT_LT(kept, 0.3 * freely);
  EXPECT_LT(kept, 0.005);
}

TEST(Bend, StopsWhenAskedTo) {
  const SolidMesh column = leaning_column();
  const auto bender = Bender::make(column, problem_of(column, {}), solid_through);
  ASSERT_TRUE(bender);
  const auto result = bender->bend(0.1, {}, Job([](double, std::string_view) { return false; }));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace aplomb::test
