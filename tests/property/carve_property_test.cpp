#include "aplomb/carve/carve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "aplomb/adapters/glpk/linear_program.h"
#include "aplomb/balance/hanging_rows.h"
#include "aplomb/balance/poses.h"
#include "aplomb/balance/stability.h"
#include "aplomb/balance/standing_rows.h"
#include "aplomb/carve/moment_tree.h"
#include "aplomb/carve/plane_search.h"
#include "aplomb/mesh/clipped_tetrahedron.h"
#include "aplomb/shell/shell.h"
#include "aplomb/volume/carvable_blocks.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

/// A figure that leans over its foot, ready to be carved.
struct Figure {
  explicit Figure(const VolumeOptions& fineness = {.wall_mm = 1.6, .voxel_mm = 0.8, .least_void_mm = 0})
      : options(fineness) {}

  TriangleMesh mesh = test::leaning_prism(16, 12, 30, 15);
  VolumeOptions options;
  SolidMesh solid = test::solid_of(mesh);
  SolidVolume volume = voxelize(solid, options).value();
  BalanceProblem problem = standing_rows(support_polygon(solid.mesh(), {}).value(), {}, RowKind::nominal);

  Carving carved(CarveAim aim, double required_t = 0) const {
    return carve(volume, solid.moments(), problem, {.aim = aim, .required_t = required_t, .least_volume_mm3 = 0})
        .value();
  }
};

/// What can be carved, cell by cell, each cut along planes by clipping its six tetrahedra.
class Cells {
 public:
  explicit Cells(const SolidVolume& volume) {
    for (const CarvableBlock& block : carvable_blocks(volume))
      for (int cell = 0; cell < CarvableBlock::cells; ++cell) {
        const double share = block.shares.empty() ? 1 : double(block.shares[cell]);
        if (share == 0) continue;
        const VoxelIndex at{block.origin[0] + cell / 64, block.origin[1] + cell / 8 % 8, block.origin[2] + cell % 8};
        cells_.push_back({volume.frame().position_mm(at), share});
      }
    size_ = volume.frame().voxel_mm;
  }

  /// Of every cell, or of its two parts on the sides of a plane.
  std::vector<Moments> pieces(const AffineForm* plane) const {
    std::vector<Moments> result;
    for (const Cell& cell : cells_) {
      const double v = cell.share * size_ * size_ * size_;
      const Moments whole{v, v * (cell.corner + 0.5 * size_ * Vec3{1, 1, 1})};
      const Moments below = plane ? part(cell, *plane) : Moments{};
      if (below.volume_mm3 > 0) result.push_back(below);
      if (below.volume_mm3 < v) result.push_back(whole - below);
    }
    return result;
  }

 private:
  struct Cell {
    Vec3 corner;
    double share;
  };

  Moments part(const Cell& cell, const AffineForm& plane) const {
    std::array<double, 8> values{};
    for (int c = 0; c < 8; ++c)
      values[c] = plane(cell.corner + size_ * Vec3{double(c & 1), double(c >> 1 & 1), double(c >> 2 & 1)});
    const Moments unit = negative_part_of_unit_cube(values);
    const double v = cell.share * size_ * size_ * size_;
    return {v * unit.volume_mm3, v * (unit.volume_mm3 * cell.corner + size_ * unit.first_mm4)};
  }

  std::vector<Cell> cells_;
  double size_ = 0;
};

/// The largest t at which shares in [0, 1] of the pieces can be kept so that every row holds: a linear program with a
/// variable per piece, t found by bisection.
double largest_t_by_pieces(const Figure& figure, const std::vector<Moments>& pieces) {
  Moments fixed = figure.solid.moments();
  for (const Moments& piece : pieces) fixed = fixed - piece;
  const auto surplus = [&](double t) {
    adapters::LinearProgram program;
    for (std::size_t i = 0; i < pieces.size(); ++i) program.variables.push_back({0, 0, 1});
    program.variables.push_back({1, -adapters::unbounded, adapters::unbounded});
    for (const BalanceRow& balance : figure.problem.rows) {
      adapters::LinearProgram::Row row;
      for (const Moments& piece : pieces) row.coefficients.push_back(balance.at(t)(piece));
      row.coefficients.push_back(-1);
      row.lower = -balance.at(t)(fixed);
      program.rows.push_back(std::move(row));
    }
    return adapters::solve(program).value().value;
  };
  double low = -1, high = 2;
  while (high - low > 1e-8) (surplus(0.5 * (low + high)) >= 0 ? low : high) = 0.5 * (low + high);
  return low;
}

TEST(Carve, ReachesWhatALinearProgramWithAVariablePerVoxelReaches) {
  const Figure figure;
  const Carving carving = figure.carved(CarveAim::stable);
  const Cells cells(figure.volume);
  EXPECT_NEAR(largest_t_by_pieces(figure, cells.pieces(&carving.kept)), carving.bound_t, 1e-6);
  const double by_whole_cells = largest_t_by_pieces(figure, cells.pieces(nullptr));
  EXPECT_LE(by_whole_cells, carving.bound_t + 1e-7);
  EXPECT_GE(by_whole_cells, carving.bound_t - 2e-3);
}

TEST(Carve, IsNeverBeatenByAMillionHalfSpaces) {
  const Figure figure;
  const Carving carving = figure.carved(CarveAim::stable);
  const MomentTree tree(carvable_blocks(figure.volume), figure.volume.frame());
  const Moments& solid = figure.solid.moments();
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Box3 box = figure.solid.box();
  const Vec3 middle = 0.5 * (box.min + box.max);
  Moments previous = solid;
  double best = -1;
  for (int i = 0; i < 1000000 / 20; ++i) {
    const Vec3 g =
        i % 2 == 0 ? Vec3{normal(random), normal(random), normal(random)}
                   : normalized(carving.kept.gradient) + 0.05 * Vec3{normal(random), normal(random), normal(random)};
    const Vec3 through = middle + 6 * Vec3{normal(random), normal(random), normal(random)};
    const Moments body = solid - tree.not_positive_part({-dot(g, through), g});
    for (int mix = 0; mix < 20; ++mix) {  // every mixture of two bodies is one that carving could leave at best
      const double share = mix / 20.0;
      best = std::max(best, largest_t(figure.problem, share * previous + (1 - share) * body));
    }
    previous = body;
  }
  EXPECT_LE(best, carving.bound_t + 1e-9);
  EXPECT_GE(best, carving.bound_t - 0.02);  // the search came close, so that the test can fail
  EXPECT_GE(carving.bound_t, largest_t(figure.problem, solid));
}

TEST(Carve, CutsAVoidThatReachesItsBound) {
  const Carving carving = Figure{}.carved(CarveAim::stable);
  EXPECT_NEAR(carving.t, carving.bound_t, 1e-3);
  EXPECT_GT(carving.t, 0.05);
}

double tip_rad_of_shell(const Figure& figure, const Carving& carving) {
  const Shell shell = build_shell(figure.solid, carving.field, {.wall_mm = figure.options.wall_mm}).value();
  const Region body{moments(shell.mesh), 1.24};
  return measure_stability(support_polygon(shell.mesh, {}).value(), {&body, 1}, {}).tip_rad;
}

TEST(Carve, RemovesLeastOrMostToMeetTheAngleToAHundredthOfADegree) {
  const Figure figure;
  const double highest = figure.carved(CarveAim::stable).bound_t;
  for (const double part : {0.3, 0.8}) {
    const double lowest = largest_t(figure.problem, figure.solid.moments());
    const double required = lowest + part * (highest - lowest);
    const Carving least = figure.carved(CarveAim::least, required), light = figure.carved(CarveAim::light, required);
    EXPECT_TRUE(least.reaches && light.reaches);
    const double hundredth_degree = 1.7453e-4;
    EXPECT_NEAR(least.t, required, 2e-5);
    EXPECT_NEAR(tip_rad_of_shell(figure, least), std::atan(required), hundredth_degree);
    const double scale = figure.solid.moments().volume_mm3;
    EXPECT_NEAR(least.field.moments().volume_mm3, least.volume_bound_mm3, 2e-3 * scale);
    EXPECT_NEAR(light.field.moments().volume_mm3, light.volume_bound_mm3, 2e-3 * scale);
    EXPECT_GE(light.field.moments().volume_mm3, least.field.moments().volume_mm3);
    EXPECT_GE(tip_rad_of_shell(figure, light), std::atan(required) - hundredth_degree);
  }
}

TEST(Carve, LeavesASolidThatStandsAlreadyAloneAndHollowsItWhenItIsToBeLight) {
  const Figure figure;
  const Carving least = figure.carved(CarveAim::least, -0.5), light = figure.carved(CarveAim::light, -0.9);
  EXPECT_TRUE(least.field.empty());
  EXPECT_TRUE(least.reaches && light.reaches);
  const MomentTree tree(carvable_blocks(figure.volume), figure.volume.frame());
  EXPECT_NEAR(light.field.moments().volume_mm3, tree.total().volume_mm3, 4e-3 * tree.total().volume_mm3);
}

TEST(Carve, GivesTheMostStableVoidWhenTheAngleIsOutOfReach) {
  const Figure figure;
  const Carving best = figure.carved(CarveAim::stable), tried = figure.carved(CarveAim::least, 1.5);
  EXPECT_FALSE(tried.reaches);
  EXPECT_EQ(tried.t, best.t);
}

/// At the largest t only one body is left, and a linear program that is next to infeasible.
TEST(Carve, MeetsAnAngleThatIsJustWithinItsReach) {
  Figure figure;
  const BalanceProblem problem = figure.problem;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-12, 12);
  for (int n = 0; n < 30; ++n) {
    const Vec3 by{shift(random), shift(random), 0};
    figure.problem = problem;
    for (BalanceRow& row : figure.problem.rows) row.a.constant -= dot(row.a.gradient, by);
    const double highest = figure.carved(CarveAim::stable).t;
    for (const CarveAim aim : {CarveAim::least, CarveAim::light})
      for (const double short_t : {0.0, 1e-7, 1e-5}) {
        const auto carving = carve(figure.volume, figure.solid.moments(), figure.problem,
                                   {.aim = aim, .required_t = highest - short_t, .least_volume_mm3 = 0});
        ASSERT_TRUE(carving) << n << ": " << carving.error().message;
        EXPECT_TRUE(carving->reaches) << n << ", short by " << highest - carving->t;
      }
  }
}

TEST(Carve, MakesAFigureStandOnItsFeetAndOnItsHeadAtOnce) {
  Figure figure;
  const StandingPose head{.up = {0, 0, -1}};
  const BalanceProblem other =
      standing_rows(support_polygon(figure.solid.mesh(), head).value(), head, RowKind::nominal);
  const double feet_only = figure.carved(CarveAim::stable).bound_t;
  figure.problem.rows.insert(figure.problem.rows.end(), other.rows.begin(), other.rows.end());
  const Carving both = figure.carved(CarveAim::stable);
  for (const BalanceRow& row : figure.problem.rows) EXPECT_GE(row.at(both.t)(both.body), -1e-6);
  EXPECT_LE(both.bound_t, feet_only + 1e-9);
  EXPECT_NEAR(both.t, both.bound_t, 2e-3);
}

/// Several poses that pull apart: the bound of their union is what a linear program over all voxels reaches.
TEST(Carve, CertifiesTheUnionOfPosesByALinearProgramWithAVariablePerVoxel) {
  Figure figure({.wall_mm = 2.4, .voxel_mm = 1.2, .least_void_mm = 0});
  const Pose feet{"feet", StandingPose{.required_tip_rad = 0.05}};
  const Pose head{"head", StandingPose{.up = {0, 0, -1}, .required_tip_rad = 0.1}};
  const Pose hook{"hook", HangingPose{.attachments_mm = {{11, 0, 24}}, .required_tilt_rad = 0.2}};
  const Pose rail{"rail", HangingPose{.attachments_mm = {{3, -4, 22}, {11, 5, 28}}, .required_tilt_rad = 0.2}};
  for (const std::vector<Pose>& poses :
       {std::vector{feet, head}, {feet, hook}, {hook, rail}, {feet, head, hook, rail}}) {
    figure.problem = joint_problem(figure.mesh, poses, RowKind::nominal).value().problem;
    const Carving carving = figure.carved(CarveAim::stable);
    const Cells cells(figure.volume);
    EXPECT_NEAR(largest_t_by_pieces(figure, cells.pieces(&carving.kept)), carving.bound_t, 2e-6);
    EXPECT_LE(largest_t_by_pieces(figure, cells.pieces(nullptr)), carving.bound_t + 1e-7);
    EXPECT_NEAR(carving.t, carving.bound_t, 4e-3);
  }
}

/// The hook is inside, mass lies above it: b has no lower bound of its own, and the certificate must still end.
TEST(Carve, CertifiesAFigureThatHangsFromAPointInside) {
  Figure figure({.wall_mm = 2.4, .voxel_mm = 1.2, .least_void_mm = 0});
  for (const double height : {12.0, 15.5, 18.0}) {
    const Pose hook{"", HangingPose{.attachments_mm = {{8, 0, height}}}};
    figure.problem = joint_problem(figure.mesh, {&hook, 1}, RowKind::nominal).value().problem;
    const Carving carving = figure.carved(CarveAim::stable);
    EXPECT_LT(carving.planes, 300) << height;
    if (carving.bound_t == -std::numeric_limits<double>::infinity()) {
      EXPECT_EQ(height, 12);
      continue;
    }
    EXPECT_LE(carving.bound_t, 1e-6);
    EXPECT_LE(largest_t_by_pieces(figure, Cells(figure.volume).pieces(nullptr)), carving.bound_t + 1e-7) << height;
  }
}

TEST(Carve, LevelsAFigureThatHangs) {
  Figure figure;
  figure.mesh = test::box({0, 0, 0}, {30, 16, 12});
  figure.solid = test::solid_of(figure.mesh);
  figure.volume = voxelize(figure.solid, figure.options).value();
  for (const double x : {16.0, 17.0, 25.0}) {  // within reach, within reach, out of reach
    const Vec3 attachment{x, 8, 12};
    figure.problem = hanging_rows({&attachment, 1}, {0, 0, 1}).value();
    const Carving carving = figure.carved(CarveAim::stable);
    EXPECT_LE(carving.t, carving.bound_t + 1e-3);
    EXPECT_NEAR(carving.t, carving.bound_t, 3e-3) << x;
    EXPECT_GT(carving.t, largest_t(figure.problem, figure.solid.moments()));
  }
}

TEST(CarveOptions, AreRefusedFieldByField) {
  const double nan = std::nan("");
  EXPECT_EQ(find_problem(CarveOptions{}), "");
  EXPECT_NE(find_problem(CarveOptions{.required_t = nan}).find("required_t"), std::string::npos);
  for (const double bad : {-1.0, 1e10, nan})
    EXPECT_NE(find_problem(CarveOptions{.least_volume_mm3 = bad}).find("least_volume"), std::string::npos);
}

}  // namespace
}  // namespace aplomb
