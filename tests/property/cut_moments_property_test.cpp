#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "aplomb/carve/moment_tree.h"
#include "aplomb/mesh/clipped_tetrahedron.h"

namespace aplomb {
namespace {

class Dice {
 public:
  double in(double low, double high) { return low + (high - low) * std::uniform_real_distribution<double>()(engine_); }
  Vec3 point() { return {in(-1, 1), in(-1, 1), in(-1, 1)}; }
  AffineForm form() { return {in(-1, 1), point()}; }

 private:
  std::mt19937 engine_{5};
};

void expect_near(const Moments& a, const Moments& b, double tolerance) {
  EXPECT_NEAR(a.volume_mm3, b.volume_mm3, tolerance);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a.first_mm4[axis], b.first_mm4[axis], tolerance);
}

Moments tetrahedron_moments(const std::array<Vec3, 4>& p) {
  const double volume = std::abs(dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0]))) / 6;
  return {volume, 0.25 * volume * (p[0] + p[1] + p[2] + p[3])};
}

/// Moments of what lies where the form is not positive, by clipping the six tetrahedra of the cube: exact.
Moments cube_part(const AffineForm& form, Vec3 origin, double size) {
  constexpr int orders[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
  Moments sum;
  for (const auto& order : orders) {
    std::array<Vec3, 4> corners;
    std::array<double, 4> values{};
    const std::array<int, 4> bits{0, order[0], order[1], 7};
    for (int i = 0; i < 4; ++i) {
      corners[i] = origin + size * Vec3{double(bits[i] & 1), double(bits[i] >> 1 & 1), double(bits[i] >> 2 & 1)};
      values[i] = form(corners[i]);
    }
    sum += negative_part(corners, values);
  }
  return sum;
}

std::array<Vec3, 4> random_tetrahedron(Dice& dice) { return {dice.point(), dice.point(), dice.point(), dice.point()}; }

std::array<double, 4> values_at(const AffineForm& form, const std::array<Vec3, 4>& corners) {
  return {form(corners[0]), form(corners[1]), form(corners[2]), form(corners[3])};
}

TEST(ClippedTetrahedron, AndItsComplementMakeTheWhole) {
  Dice dice;
  for (int i = 0; i < 5000; ++i) {
    const auto corners = random_tetrahedron(dice);
    const AffineForm form = dice.form();
    const Moments below = negative_part(corners, values_at(form, corners));
    const Moments above = negative_part(corners, values_at(-1.0 * form, corners));
    expect_near(below + above, tetrahedron_moments(corners), 1e-12);
    EXPECT_LE(form(below), 1e-12);
    EXPECT_GE(form(above), -1e-12);
  }
}

/// Where all corners of a part lie on one side it counts whole; the rest is halved along its longest edge.
Moments subdivided(const std::array<Vec3, 4>& p, const AffineForm& form, int depth) {
  const auto values = values_at(form, p);
  const auto [least, greatest] = std::ranges::minmax(values);
  if (least >= 0) return {};
  if (greatest <= 0) return tetrahedron_moments(p);
  if (depth == 0) return (least / (least - greatest)) * tetrahedron_moments(p);
  int a = 0, b = 1;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j)
      if (norm(p[i] - p[j]) > norm(p[a] - p[b])) a = i, b = j;
  auto left = p, right = p;
  left[a] = right[b] = 0.5 * (p[a] + p[b]);
  return subdivided(left, form, depth - 1) + subdivided(right, form, depth - 1);
}

TEST(ClippedTetrahedron, IsWhatSubdividingItFinds) {
  Dice dice;
  for (int i = 0; i < 20; ++i) {
    const auto corners = random_tetrahedron(dice);
    const AffineForm form = dice.form();
    expect_near(negative_part(corners, values_at(form, corners)), subdivided(corners, form, 21), 2e-4);
  }
}

TEST(ClippedTetrahedron, OfTheUnitCornerIsTheCubeOfItsHeight) {
  const std::array<Vec3, 4> corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (const double s : {0.1, 0.3, 0.9}) {  // x + y + z < s
    const Moments part = negative_part(corner, {-s, 1 - s, 1 - s, 1 - s});
    expect_near(part, {s * s * s / 6, s * s * s * s / 24 * Vec3{1, 1, 1}}, 1e-15);
    expect_near(tetrahedron_moments(corner) - part, negative_part(corner, {s, s - 1, s - 1, s - 1}), 1e-15);
  }
}

TEST(CutCube, IsWhatItsTetrahedraAddUpTo) {
  Dice dice;
  for (int i = 0; i < 20000; ++i) {
    const AffineForm form = dice.form();
    expect_near(cut_cube(form, {-0.3, -0.5, -0.4}, 0.8), cube_part(form, {-0.3, -0.5, -0.4}, 0.8), 1e-6);
  }
}

TEST(CutCube, IsExactForPlanesThatLieAlongItsFacesAndEdges) {
  Dice dice;
  for (int i = 0; i < 20000; ++i) {
    AffineForm form = dice.form();
    form.gradient[i % 3] *= std::pow(10, -dice.in(1, 12));
    if (i % 2 == 0) form.gradient[(i + 1) % 3] *= std::pow(10, -dice.in(1, 12));
    if (i % 7 == 0) form.gradient[i % 3] = 0;
    if (i % 11 == 0) form.gradient[(i + 1) % 3] = 0;
    expect_near(cut_cube(form, {-0.5, -0.5, -0.5}, 1), cube_part(form, {-0.5, -0.5, -0.5}, 1), 1e-6);
  }
}

TEST(CutCube, AndItsComplementMakeTheWhole) {
  Dice dice;
  for (int i = 0; i < 5000; ++i) {
    const AffineForm form = dice.form();
    const Vec3 at = 10.0 * dice.point();
    const Moments sum = cut_cube(form, at, 0.5) + cut_cube(-1.0 * form, at, 0.5);
    expect_near(sum, {0.125, 0.125 * (at + Vec3{0.25, 0.25, 0.25})}, 1e-7);
  }
}

/// Blocks in a ball's shape: whole ones, and ones with random shares.
std::vector<CarvableBlock> random_blocks(Dice& dice) {
  std::vector<CarvableBlock> blocks;
  for (int i = -3; i < 3; ++i)
    for (int j = -3; j < 3; ++j)
      for (int k = -3; k < 3; ++k) {
        if (i * i + j * j + k * k > 10) continue;
        CarvableBlock block{{8 * i, 8 * j, 8 * k}, {}};
        if (dice.in(0, 1) < 0.5)
          for (int cell = 0; cell < CarvableBlock::cells; ++cell)
            block.shares.push_back(static_cast<float>(std::max(0.0, dice.in(-0.5, 1))));
        blocks.push_back(std::move(block));
      }
  return blocks;
}

Moments direct_sum(const std::vector<CarvableBlock>& blocks, const VoxelFrame& frame, const AffineForm& form) {
  Moments sum;
  for (const CarvableBlock& block : blocks)
    for (int cell = 0; cell < CarvableBlock::cells; ++cell) {
      const double share = block.shares.empty() ? 1 : double(block.shares[cell]);
      const VoxelIndex at{block.origin[0] + cell / 64, block.origin[1] + cell / 8 % 8, block.origin[2] + cell % 8};
      sum += share * cube_part(form, frame.position_mm(at), frame.voxel_mm);
    }
  return sum;
}

TEST(MomentTree, SumsWhatTheCellsOnOneSideOfAPlaneAddUpTo) {
  Dice dice;
  const std::vector<CarvableBlock> blocks = random_blocks(dice);
  const VoxelFrame frame{0.05, {0.1, 0.2, 0.3}};
  const MomentTree tree(blocks, frame);
  for (int i = 0; i < 20; ++i) {
    const AffineForm form = dice.form();
    expect_near(tree.not_positive_part(form), direct_sum(blocks, frame, form), 1e-7);
  }
  expect_near(tree.not_positive_part({-1, {}}), tree.total(), 1e-12);
  expect_near(tree.not_positive_part({1, {}}), {}, 0);
}

TEST(MomentTree, SplitsTheWholeAtEveryPlane) {
  Dice dice;
  const MomentTree tree(random_blocks(dice), {0.05, {0.1, 0.2, 0.3}});
  for (int i = 0; i < 500; ++i) {
    const AffineForm form = dice.form();
    expect_near(tree.not_positive_part(form) + tree.not_positive_part(-1.0 * form), tree.total(), 1e-7);
  }
}

TEST(MomentTree, ChangesContinuouslyWithThePlane) {
  Dice dice;
  const MomentTree tree(random_blocks(dice), {0.05, {0.1, 0.2, 0.3}});
  for (int i = 0; i < 500; ++i) {
    const AffineForm form = dice.form(), step = 1e-7 * dice.form();
    expect_near(tree.not_positive_part(form + step), tree.not_positive_part(form), 1e-5);
  }
}

TEST(MomentTree, GivesEachPlaneTheBestOfAllItsHalfSpaces) {
  Dice dice;
  const MomentTree tree(random_blocks(dice), {0.05, {0.1, 0.2, 0.3}});
  for (int i = 0; i < 300; ++i) {
    const AffineForm form = dice.form(), other = dice.form();
    EXPECT_LE(form(tree.not_positive_part(form)), form(tree.not_positive_part(other)) + 1e-9);
  }
}

}  // namespace
}  // namespace aplomb
