#include "aplomb/volume/solid_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "aplomb/carve/moment_tree.h"
#include "aplomb/carve/void_field.h"
#include "aplomb/volume/carvable_blocks.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

constexpr AffineForm carve_all{-1, {}};

SolidVolume volume_of(const TriangleMesh& mesh, const VolumeOptions& options) {
  return voxelize(test::solid_of(mesh), options).value();
}

Moments carvable_moments(const SolidVolume& volume) {
  return MomentTree(carvable_blocks(volume), volume.frame()).total();
}

TEST(Voxelize, LeavesOfABoxTheBoxAWallSmallerOnEverySide) {
  const VolumeOptions options{.wall_mm = 2, .voxel_mm = 0.25, .least_void_mm = 0};
  const double depth = carving_depth_mm(options);
  const Moments carvable = carvable_moments(volume_of(test::box({0, 0, 0}, {20, 16, 12}), options));
  const Vec3 inner = Vec3{20, 16, 12} - 2 * depth * Vec3{1, 1, 1};
  EXPECT_NEAR(carvable.volume_mm3, inner.x * inner.y * inner.z, 2e-3 * inner.x * inner.y * inner.z);
  EXPECT_NEAR(norm(carvable.centroid_mm() - Vec3{10, 8, 6}), 0, 5e-3);
}

TEST(Voxelize, LeavesOfABallTheBallAWallSmaller) {
  const VolumeOptions options{.wall_mm = 2, .voxel_mm = 0.25, .least_void_mm = 1};
  const double radius = 10 - carving_depth_mm(options);
  const Moments carvable = carvable_moments(volume_of(test::sphere({3, 2, 1}, 10, 5), options));
  const double expected = 4 * std::numbers::pi / 3 * std::pow(radius, 3);
  EXPECT_NEAR(carvable.volume_mm3, expected, 2e-3 * expected);
  EXPECT_NEAR(norm(carvable.centroid_mm() - Vec3{3, 2, 1}), 0, 1e-3);
}

TEST(Voxelize, ApproachesTheExactRegionWithTheSquareOfTheVoxel) {
  const TriangleMesh corner = test::tetrahedron({0, 0, 0}, {24, 0, 0}, {0, 24, 0}, {0, 0, 24});
  const double volume = moments(corner).volume_mm3, inradius = 24 / (3 + std::sqrt(3.0));
  std::vector<double> errors;
  for (const double voxel_mm : {0.8, 0.4, 0.2}) {
    const VolumeOptions options{.wall_mm = 1.6, .voxel_mm = voxel_mm, .least_void_mm = 0};
    const double expected = volume * std::pow(1 - carving_depth_mm(options) / inradius, 3);
    errors.push_back(std::abs(carvable_moments(volume_of(corner, options)).volume_mm3 - expected));
  }
  EXPECT_LT(errors[1], 0.35 * errors[0]);
  EXPECT_LT(errors[2], 0.35 * errors[1]);
}

void expect_exact_distances(const TriangleMesh& mesh, const VolumeOptions& options) {
  const SolidVolume volume = volume_of(mesh, options);
  const TriangleMesh surface = rounded_to_float(mesh);
  const double gap = 0.05 * options.voxel_mm + 1e-9, depth = carving_depth_mm(options);
  const std::vector<CornerCell> cells = boundary_cells(cut_void(volume, carve_all, 0)->field);
  ASSERT_GT(cells.size(), 100u);
  for (std::size_t n = 0; n < cells.size(); n += 7)
    for (int c = 0; c < 8; ++c) {
      const auto& [i, j, k] = cells[n].ijk;
      const Vec3 at = volume.frame().position_mm({i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)});
      const double distance = test::brute_force_distance_mm(surface, at);
      const double exact = depth - (test::is_inside(surface, at) ? distance : -distance);
      if (std::abs(exact) > gap) ASSERT_NEAR(double(cells[n].values[c]), exact, 1e-5);
      else ASSERT_NEAR(double(cells[n].values[c]), gap, 1e-6);
    }
}

TEST(Voxelize, SamplesExactDistancesWhereverItsRegionEnds) {
  const VolumeOptions options{.wall_mm = 1.5, .voxel_mm = 0.5, .least_void_mm = 0};
  expect_exact_distances(test::star_prism(5, 20, 9, 12), options);
  expect_exact_distances(test::sphere({1, 2, 3}, 10, 3), options);
  expect_exact_distances(test::torus({0, 0, 0}, 10, 4, 24, 16), options);
  expect_exact_distances(test::tetrahedron({0, 0, 0}, {30, 0, 0}, {0, 30, 0}, {0, 0, 30}), options);
}

TEST(Voxelize, SamplesExactDistancesWithAWallOfTwoVoxels) {
  const VolumeOptions options{.wall_mm = 1, .voxel_mm = 0.5, .least_void_mm = 0};
  expect_exact_distances(test::dumbbell({{8, 0}, {6, 15}}, 4, 24), options);
  expect_exact_distances(test::box({0, 0, 0}, {9, 8, 7}), options);
}

TEST(Voxelize, FindsNothingToCarveInWhatIsThinnerThanTwoWalls) {
  const SolidVolume volume = volume_of(test::box({0, 0, 0}, {30, 30, 4}), {.wall_mm = 2, .voxel_mm = 0.5});
  EXPECT_TRUE(carvable_blocks(volume).empty());
  EXPECT_TRUE(cut_void(volume, carve_all, 0)->field.empty());
}

TEST(Voxelize, GivesTheSameRegionWhereverTheSolidLies) {
  const TriangleMesh star = rounded_to_float(test::star_prism(5, 20, 9, 12));
  const Vec3 by{256, -512, 1024};  // exact in float32 to 2^-13 mm
  const TriangleMesh there = transformed(star, test::translation(by));
  const VolumeOptions options{.wall_mm = 1.5, .voxel_mm = 0.5};
  const Moments here = carvable_moments(volume_of(star, options)), moved = carvable_moments(volume_of(there, options));
  EXPECT_NEAR(moved.volume_mm3, here.volume_mm3, 1e-4 * here.volume_mm3);
  EXPECT_NEAR(norm(moved.centroid_mm() - here.centroid_mm() - by), 0, 1e-3);
}

TEST(Voxelize, RefusesWhatWouldTakeMoreMemoryThanIsAllowed) {
  const SolidMesh solid = test::solid_of(test::box({0, 0, 0}, {1000, 1000, 1000}));
  const VolumeOptions options{.wall_mm = 0.002, .voxel_mm = 0.001, .least_void_mm = 0.01};
  const auto refused = voxelize(solid, options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::over_budget);
  EXPECT_GT(estimated_bytes(solid, options), options.memory_bytes);
}

TEST(Voxelize, EstimatesAtLeastTheMemoryThatItsGridTakes) {
  const VolumeOptions options{.wall_mm = 2, .voxel_mm = 0.25};
  for (const TriangleMesh& mesh : {test::box({0, 0, 0}, {40, 40, 40}), test::sphere({}, 20, 4)}) {
    const SolidMesh solid = test::solid_of(mesh);
    EXPECT_LT(voxelize(solid, options).value().memory_bytes(), estimated_bytes(solid, options));
  }
}

TEST(VolumeOptions, AreRefusedFieldByField) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(find_problem(VolumeOptions{}), "");
  const std::vector<std::pair<VolumeOptions, std::string>> broken{{{.wall_mm = 0}, "wall_mm"},
                                                                  {{.wall_mm = nan}, "wall_mm"},
                                                                  {{.wall_mm = 1e5}, "wall_mm"},
                                                                  {{.voxel_mm = 0}, "voxel_mm"},
                                                                  {{.voxel_mm = 1.01}, "voxel_mm"},
                                                                  {{.voxel_mm = nan}, "voxel_mm"},
                                                                  {{.least_void_mm = -1}, "least_void"},
                                                                  {{.least_void_mm = 16.1}, "least_void"},
                                                                  {{.least_void_mm = nan}, "least_void"},
                                                                  {{.memory_bytes = 0}, "memory_bytes"}};
  for (const auto& [options, field] : broken)
    EXPECT_NE(find_problem(options).find(field), std::string::npos) << field << ": " << find_problem(options);
}

}  // namespace
}  // namespace aplomb
