#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "aplomb/balance/standing_rows.h"
#include "aplomb/deform/bend.h"
#include "aplomb/deform/cage.h"
#include "aplomb/deform/deform_cage.h"
#include "support/elephant.h"
#include "support/solids.h"

/// What the prototype found the hard way: an energy that is blind to turning folds a figure over, one blind to volume
/// makes parts of it swell and shrink, and without a ground mass sinks below the plate. Each term is left out once.
namespace aplomb::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The elephant on small feet, asked for 20 degrees.
CageProblem elephant_problem(double foot_ratio) {
  const SolidMesh elephant = solid_of(elephant_on_small_feet(foot_ratio));
  const auto support = support_polygon(elephant.mesh(), {});
  const auto cage = build_cage(elephant, {.wall_mm = 2, .samples = 20000});
  EXPECT_TRUE(support && cage);
  CageProblem problem;
  problem.rest = cage->mesh();
  problem.solid_share = cage->solid_share();
  problem.stiffness.assign(problem.rest.tets.size(), 1);
  problem.samples = cage->samples();
  problem.balance = standing_rows(*support, {}, RowKind::nominal);
  problem.required_t = std::tan(20 * degree);
  problem.grounds = {{}};
  problem.fixed.assign(problem.rest.vertices.size(), false);
  const auto held = vertices_near_plate(elephant.mesh(), {0, 0, 1}, 0.1);
  for (std::size_t v = 0; v < held.size(); ++v)
    if (held[v])
      for (const std::uint32_t corner : problem.rest.tets[cage->embed(elephant.mesh().vertices[v])->tet])
        problem.fixed[corner] = true;
  return problem;
}

/// How the shape came through.
struct Damage {
  double turn_deg = 0;                       ///< the largest
  double sunk_mm = 0;                        ///< below the plate, or below where it was there
  double least_volume = 1, most_volume = 1;  ///< det F where the solid fills at least 30 %: less is mostly air
  double trunk_volume = 1, ear_volume = 1;   ///< of the part, over what it was
};

double volume_mm3(const std::vector<Vec3>& v, const TetMesh::Tet& t) {
  return signed_volume(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
}

double part_volume_ratio(const CageProblem& problem, const std::vector<Vec3>& vertices, bool (*is_part)(Vec3)) {
  double before = 0, after = 0;
  for (std::size_t t = 0; t < problem.rest.tets.size(); ++t) {
    const TetMesh::Tet& tet = problem.rest.tets[t];
    const std::vector<Vec3>& rest = problem.rest.vertices;
    if (!is_part(0.25 * (rest[tet[0]] + rest[tet[1]] + rest[tet[2]] + rest[tet[3]]))) continue;
    before += problem.solid_share[t] * volume_mm3(rest, tet);
    after += problem.solid_share[t] * volume_mm3(vertices, tet);
  }
  return after / before;
}

Damage damage(const CageProblem& problem, const CageDeformation& bent) {
  Damage damage;
  damage.turn_deg = bent.max_turn_rad / degree;
  for (std::size_t v = 0; v < bent.vertices.size(); ++v)
    damage.sunk_mm = std::max(damage.sunk_mm, std::min(0.0, problem.rest.vertices[v].z) - bent.vertices[v].z);
  for (std::size_t t = 0; t < problem.rest.tets.size(); ++t) {
    if (problem.solid_share[t] < 0.3) continue;
    const auto& tet = problem.rest.tets[t];
    const double change = volume_mm3(bent.vertices, tet) / volume_mm3(problem.rest.vertices, tet);
    damage.least_volume = std::min(damage.least_volume, change);
    damage.most_volume = std::max(damage.most_volume, change);
  }
  damage.trunk_volume = part_volume_ratio(problem, bent.vertices, is_trunk);
  damage.ear_volume = part_volume_ratio(problem, bent.vertices, is_left_ear);
  return damage;
}

class FoldTrap : public ::testing::Test {
 protected:
  /// On feet of half the size it reaches 20 degrees, however it is asked.
  static Damage done(const DeformOptions& options) {
    static const CageProblem problem = elephant_problem(0.5);
    const auto bent = deform_cage(problem, options);
    EXPECT_TRUE(bent);
    EXPECT_GT(bent->t, std::tan(19 * degree));
    return damage(problem, *bent);
  }
};

TEST_F(FoldTrap, AnElephantOnSmallFeetLeansToTwentyDegreesInGoodShape) {
  const Damage d = done({});
  EXPECT_LT(d.turn_deg, 45);
  EXPECT_LT(d.sunk_mm, 0.02);
  EXPECT_GT(d.least_volume, 0.64);
  EXPECT_LT(d.most_volume, 1.18);
  EXPECT_NEAR(d.trunk_volume, 1, 0.03);
  EXPECT_NEAR(d.ear_volume, 1, 0.03);
}

TEST_F(FoldTrap, ItFoldsOverWhereTurningCostsNothing) { EXPECT_GT(done({.beta_ratio = 0}).turn_deg, 75); }

TEST_F(FoldTrap, ItSinksBelowThePlateWhereThereIsNoGround) { EXPECT_GT(done({.ground_ratio = 0}).sunk_mm, 1); }

TEST_F(FoldTrap, ItsTrunkAndEarsLoseTheirVolumeWhereThatCostsNothing) {
  const Damage d = done({.gamma_ratio = 0});
  EXPECT_LT(d.trunk_volume, 0.9);
  EXPECT_LT(d.ear_volume, 0.9);
  EXPECT_LT(d.least_volume, 0.64);
  EXPECT_GT(d.most_volume, 1.18);
}

TEST(FoldTrapLimit, WhatCannotBeReachedInGoodShapeEndsAtTheLimitInGoodShape) {
  const CageProblem problem = elephant_problem(0.35);
  const auto bent = deform_cage(problem, {.most_mean_mm = 4.2});
  ASSERT_TRUE(bent);
  EXPECT_EQ(bent->outcome, DeformOutcome::limit);
  EXPECT_GT(bent->t, std::tan(11 * degree));
  const Damage d = damage(problem, *bent);
  EXPECT_LT(d.turn_deg, 25);
  EXPECT_LT(d.sunk_mm, 0.02);
  EXPECT_GT(d.least_volume, 0.75);
  EXPECT_LT(d.most_volume, 1.1);
}

}  // namespace
}  // namespace aplomb::test
