#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "aplomb/balance/standing_rows.h"
#include "aplomb/carve/carve.h"
#include "aplomb/shell/shell.h"
#include "aplomb/volume/carvable_blocks.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

/// The stages from solid to shell, one after the other.
struct Stages {
  SolidMesh solid = test::solid_of(test::leaning_prism(16, 12, 30, 12));
  VolumeOptions options{.wall_mm = 1.6, .voxel_mm = 0.8};
  BalanceProblem problem = standing_rows(support_polygon(solid.mesh(), {}).value(), {}, RowKind::nominal);

  Result<SolidVolume> volume(const Job& job = {}) const { return voxelize(solid, options, job); }
  Result<Carving> carving(const SolidVolume& volume, const Job& job = {}) const {
    return carve(volume, solid.moments(), problem, {.aim = CarveAim::least, .required_t = 0.15}, job);
  }
  Result<Shell> shell(const Carving& carving, const Job& job = {}) const {
    return build_shell(solid, carving.field, {.wall_mm = options.wall_mm}, job);
  }
};

/// Cancels a stage at each of its reports.
template <class Stage>
void expect_cancelled_at_every_report(const Stage& stage) {
  test::CancelAt never(1 << 30);
  ASSERT_TRUE(stage(never.job()).has_value());
  ASSERT_GT(never.reports(), 0);
  for (int k = 1; k <= never.reports(); ++k) {
    test::CancelAt at_k(k);
    const auto result = stage(at_k.job());
    ASSERT_FALSE(result.has_value()) << "at report " << k;
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
    EXPECT_EQ(at_k.reports(), k) << "asked again after it was told to stop";
  }
}

TEST(CarvingStages, AreCancelledAtEveryReport) {
  const Stages stages;
  const SolidVolume volume = stages.volume().value();
  const Carving carving = stages.carving(volume).value();
  const Shell shell = stages.shell(carving).value();
  ASSERT_GT(shell.voids, 0u);
  expect_cancelled_at_every_report([&](const Job& job) { return stages.volume(job); });
  expect_cancelled_at_every_report([&](const Job& job) { return stages.carving(volume, job); });
  expect_cancelled_at_every_report([&](const Job& job) { return stages.shell(carving, job); });
  expect_cancelled_at_every_report([&](const Job& job) { return check_solid(shell.mesh, job); });
}

TEST(CarvingStages, ReportSharesThatGrowFromNothingToAll) {
  const Stages stages;
  double last = 0;
  const Job job([&](double share, std::string_view) {
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1 + 1e-12);
    last = share;
    return true;
  });
  const SolidVolume volume = stages.volume(job).value();
  EXPECT_LT(last, 1);
  last = 0;
  const Carving carving = stages.carving(volume, job).value();
  EXPECT_EQ(last, 1);
  last = 0;
  EXPECT_TRUE(stages.shell(carving, job).has_value());
}

TEST(CarvingStages, MakeTheSameShellWithOneTwoAndEightThreads) {
  const Stages stages;
  std::vector<Shell> shells;
  std::vector<Carving> carvings;
  for (const std::size_t threads : {1, 2, 8, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    carvings.push_back(stages.carving(stages.volume().value()).value());
    shells.push_back(stages.shell(carvings.back()).value());
  }
  for (std::size_t i = 1; i < shells.size(); ++i) {
    EXPECT_EQ(carvings[i].body, carvings[0].body);
    EXPECT_EQ(carvings[i].bound_t, carvings[0].bound_t);
    EXPECT_EQ(shells[i].mesh, shells[0].mesh);
    EXPECT_EQ(shells[i].wall_mm, shells[0].wall_mm);
  }
}

TEST(CarvingStages, DropPartsTooSmallToCarveAndSolveAgainWithoutThem) {
  const SolidMesh solid = test::solid_of(test::dumbbell({{9, 9}, {8, 27}, {3.5, 40}}, 2, 32));
  const SolidVolume volume = voxelize(solid, {.wall_mm = 1.5, .voxel_mm = 0.5}).value();
  const VoidCut all = cut_void(volume, {-1, {}}, 0).value(), large = cut_void(volume, {-1, {}}, 100).value();
  EXPECT_EQ(all.dropped_parts, 0u);
  EXPECT_EQ(large.dropped_parts, 1u);
  EXPECT_FALSE(all.without_dropped.has_value());
  ASSERT_TRUE(large.without_dropped.has_value());
  const double tiny = 4.18879 * 8;  // a ball of radius 2
  EXPECT_NEAR(all.field.moments().volume_mm3 - large.field.moments().volume_mm3, tiny, 0.35 * tiny);
  EXPECT_NEAR(large.dropped_mm3, tiny, 0.35 * tiny);
  const VoidCut again = cut_void(*large.without_dropped, {-1, {}}, 100).value();
  EXPECT_EQ(again.dropped_parts, 0u);
  EXPECT_EQ(again.field.moments(), large.field.moments());
  const Shell shell = build_shell(solid, large.field, {.wall_mm = 1.5}).value();
  EXPECT_EQ(shell.voids, 2u);
}

TEST(CarvingStages, CountTheDroppedPartsAndKeepTheBoundOfWhatIsShipped) {
  const SolidMesh solid = test::solid_of(test::dumbbell({{9, 9}, {8, 27}, {3.5, 40}}, 2, 32));
  const SolidVolume volume = voxelize(solid, {.wall_mm = 1.5, .voxel_mm = 0.5}).value();
  const BalanceProblem problem{{{{8, {1, 0, 0}}, {0, {0, 0, 1}}}, {{8, {-1, 0, 0}}, {0, {0, 0, 1}}}}};
  const CarveOptions some{.aim = CarveAim::stable, .least_volume_mm3 = 100};
  const Carving carving = carve(volume, solid.moments(), problem, some).value();
  const Carving with_tiny =
      carve(volume, solid.moments(), problem, {.aim = CarveAim::stable, .least_volume_mm3 = 0}).value();
  EXPECT_GE(carving.dropped_parts, 1u);
  EXPECT_LT(carving.bound_t, with_tiny.bound_t);
  EXPECT_NEAR(carving.t, carving.bound_t, 2e-3);
  EXPECT_GT(carving.t, largest_t(problem, solid.moments()));
}

/// Every point of the void lies in a ball of the least width inside it: seen on the cells whose corners are all inside.
TEST(CarvingStages, OpenTheVoidByItsLeastWidth) {
  const TriangleMesh wedge = test::prism({{0, 0}, {40, 0}, {40, 24}}, 0, {0, 0, 24});
  const double least_void = 4, voxel = 0.5;
  const auto points = [&](double width) {
    const SolidVolume volume =
        voxelize(test::solid_of(wedge), {.wall_mm = 2, .voxel_mm = voxel, .least_void_mm = width}).value();
    std::vector<Vec3> inside;
    for (const CornerCell& cell : boundary_cells(cut_void(volume, {-1, {}}, 0)->field))
      for (int c = 0; c < 8; ++c)
        if (cell.values[c] < 0)
          inside.push_back(volume.frame().position_mm(
              {cell.ijk[0] + (c & 1), cell.ijk[1] + (c >> 1 & 1), cell.ijk[2] + (c >> 2 & 1)}));
    return inside;
  };
  // In the wedge's sharp corner the ball of radius r touches both sides; nothing beyond it is carved.
  const double slope = std::atan2(24, 40), depth = carving_depth_mm({.wall_mm = 2, .voxel_mm = voxel});
  const double ball_x = (depth + least_void / 2) / std::tan(slope / 2), tip_x = depth / std::tan(slope / 2);
  double least = 1e9, sharp = 1e9;
  for (const Vec3 p : points(least_void)) least = std::min(least, p.x);
  for (const Vec3 p : points(0)) sharp = std::min(sharp, p.x);
  EXPECT_GT(least, ball_x - least_void / 2 - 1.5 * voxel);
  EXPECT_LT(least, ball_x - least_void / 2 + 1.5 * voxel);
  EXPECT_LT(sharp, tip_x + 3 * voxel);
  EXPECT_GT(least, sharp + 2 * voxel);
}

}  // namespace
}  // namespace aplomb
