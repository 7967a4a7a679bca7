#include "aplomb/shell/shell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "aplomb/adapters/embree/surface_distance.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

constexpr AffineForm carve_all{-1, {}};

struct Carved {
  SolidMesh solid;
  VoidField field;
  Shell shell;
};

Carved carved(const TriangleMesh& mesh, const VolumeOptions& options, const AffineForm& kept = carve_all) {
  const SolidMesh solid = test::solid_of(mesh);
  const VoidField field = cut_void(voxelize(solid, options).value(), kept, 10)->field;
  return {solid, field, build_shell(solid, field, {.wall_mm = options.wall_mm}).value()};
}

TriangleMesh void_surface(const Shell& shell) {
  return {shell.mesh.vertices, {shell.mesh.triangles.begin() + shell.outer_triangles, shell.mesh.triangles.end()}};
}

/// From points strewn over the void's surface, a thousand and its corners.
double sampled_wall_mm(const Carved& carved) {
  const adapters::SurfaceDistance outer(carved.solid.mesh());
  const TriangleMesh inner = void_surface(carved.shell);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share;
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : inner.triangles) {
    const Vec3 a = inner.vertices[t[0]], b = inner.vertices[t[1]], c = inner.vertices[t[2]];
    for (int i = 0; i < 20; ++i) {
      double u = share(random), v = share(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      if (i < 3) u = i == 1, v = i == 2;
      least = std::min(least, outer.closest(a + u * (b - a) + v * (c - a)).distance_mm);
    }
  }
  return least;
}

void expect_sound(const Carved& carved, double wall_mm) {
  const Shell& shell = carved.shell;
  ASSERT_GT(shell.voids, 0u);
  EXPECT_EQ(describe(check_solid(shell.mesh).value().defects), "no defect");
  EXPECT_GE(shell.wall_mm, wall_mm);
  EXPECT_GE(sampled_wall_mm(carved), shell.wall_mm);
  EXPECT_NEAR(sampled_wall_mm(carved), shell.wall_mm, 0.02 * wall_mm);
  const double left = moments(shell.mesh).volume_mm3, void_mm3 = carved.field.moments().volume_mm3;
  EXPECT_NEAR(left, carved.solid.moments().volume_mm3 - void_mm3, 5e-3 * void_mm3);
}

struct Case {
  const char* name;
  TriangleMesh mesh;
};

std::vector<Case> cases() {
  return {{"box", test::box({0, 0, 0}, {20, 16, 12})},
          {"ball", test::sphere({1, 2, 3}, 10, 4)},
          {"torus", test::torus({0, 0, 0}, 14, 6, 48, 32)},
          {"star", test::star_prism(5, 20, 8, 14)},
          {"tetrahedron", test::tetrahedron({0, 0, 0}, {35, 0, 0}, {0, 35, 0}, {0, 0, 35})},
          {"dumbbell", test::dumbbell({{9, 0}, {7, 17}}, 4, 32)}};
}

TEST(Shell, KeepsTheWallOfEveryShapeAtEveryVoxel) {
  for (const auto& [name, mesh] : cases())
    for (const double voxels : {2.0, 3.3}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(voxels));
      expect_sound(carved(mesh, {.wall_mm = 1.5, .voxel_mm = 1.5 / voxels}), 1.5);
    }
}

TEST(Shell, KeepsTheWallFarFromTheOriginWhereFloatsAreCoarse) {
  for (const auto& [name, mesh] : cases()) {
    SCOPED_TRACE(name);
    const TriangleMesh there = transformed(mesh, test::translation({10000.1, -7000.3, 3000.7}));
    expect_sound(carved(there, {.wall_mm = 1.5, .voxel_mm = 0.6}), 1.5);
  }
}

TEST(Shell, KeepsTheWallOfHalvesCutBySlantingPlanes) {
  const Vec3 slanting{0.5, 0.3, -0.2};
  for (const auto& [name, mesh] : cases()) {
    SCOPED_TRACE(name);
    const AffineForm half{-dot(slanting, moments(mesh).centroid_mm()), slanting};
    expect_sound(carved(mesh, {.wall_mm = 1, .voxel_mm = 0.5}, half), 1);
  }
}

TEST(Shell, LeavesTheSolidsOwnTrianglesFirstAndUntouched) {
  for (const auto& [name, mesh] : cases()) {
    const auto [solid, field, shell] = carved(mesh, {.wall_mm = 1.5, .voxel_mm = 0.6});
    const TriangleMesh& outer = solid.mesh();
    ASSERT_EQ(shell.outer_triangles, outer.triangles.size());
    EXPECT_TRUE(std::equal(outer.vertices.begin(), outer.vertices.end(), shell.mesh.vertices.begin()));
    EXPECT_TRUE(std::equal(outer.triangles.begin(), outer.triangles.end(), shell.mesh.triangles.begin()));
    EXPECT_EQ(shell.mesh, rounded_to_float(shell.mesh));
  }
}

TEST(Shell, WindsItsVoidsTheOtherWay) {
  const auto [solid, field, shell] = carved(test::sphere({}, 10, 4), {.wall_mm = 2, .voxel_mm = 0.5});
  EXPECT_EQ(shell.voids, 1u);
  const double radius = 10 - carving_depth_mm({.wall_mm = 2, .voxel_mm = 0.5});
  EXPECT_NEAR(moments(void_surface(shell)).volume_mm3, -4 * std::numbers::pi / 3 * std::pow(radius, 3), 20);
}

TEST(Shell, OfNoVoidIsTheSolid) {
  const SolidMesh solid = test::solid_of(test::sphere({}, 10, 3));
  const Shell shell = build_shell(solid, {}, {}).value();
  EXPECT_EQ(shell.mesh, solid.mesh());
  EXPECT_EQ(shell.voids, 0u);
  EXPECT_EQ(shell.wall_mm, std::numeric_limits<double>::infinity());
}

TEST(Shell, KeepsTheVoidThatASolidAlreadyHasAndTheMaterialRoundItInOnePiece) {
  const TriangleMesh ball = test::sphere({}, 15, 4), hole = test::sphere({2, 1, 0}, 3, 2);
  const auto result = carved(test::with_void(ball, hole), {.wall_mm = 1.5, .voxel_mm = 0.6});
  expect_sound(result, 1.5);
  const SolidMesh shell = *check_solid(result.shell.mesh).value().solid;
  EXPECT_EQ(shell.bodies(), 1u);
  EXPECT_EQ(shell.voids(), 2u);
  EXPECT_EQ(result.shell.loose_mm3, 0);
}

TEST(Shell, HoldsEveryVoidThatASolidAlreadyHas) {
  TriangleMesh block = test::box({0, 0, 0}, {36, 12, 12});
  for (const double x : {6.0, 18.0, 30.0}) block = test::with_void(block, test::sphere({x, 6, 6}, 1, 2));
  block = test::with_void(block, test::box({17, 5, 1.7}, {19, 7, 2.3}));
  const auto result = carved(block, {.wall_mm = 1, .voxel_mm = 0.5});
  expect_sound(result, 1);
  EXPECT_EQ(check_solid(result.shell.mesh).value().solid->bodies(), 1u);
}

TEST(ShellOptions, AreRefusedFieldByField) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(find_problem(ShellOptions{}), "");
  for (const double bad : {0.0, -1.0, nan})
    EXPECT_NE(find_problem(ShellOptions{.wall_mm = bad}).find("wall_mm"), std::string::npos);
  for (const double bad : {-0.1, 1.1, nan})
    EXPECT_NE(find_problem(ShellOptions{.deviation_voxels = bad}).find("deviation_voxels"), std::string::npos);
}

}  // namespace
}  // namespace aplomb
