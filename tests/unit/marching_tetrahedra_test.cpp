#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "aplomb/mesh/marching_tetrahedra.h"
#include "aplomb/mesh/mass_properties.h"

namespace aplomb {
namespace {

template <class Field>
std::vector<CornerCell> cells_of(int size, Field field) {
  std::vector<CornerCell> cells;
  for (int k = -size; k < size; ++k)
    for (int j = -size; j < size; ++j)
      for (int i = -size; i < size; ++i) {
        CornerCell cell{{i, j, k}, {}};
        int inside = 0;
        for (int c = 0; c < 8; ++c) {
          cell.values[c] = field(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
          inside += cell.values[c] < 0;
        }
        if (inside != 0 && inside != 8) cells.push_back(cell);
      }
  return cells;
}

/// True when every directed edge occurs once and its reverse once.
bool is_closed_and_oriented(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      if (!edges.insert({t[i], t[(i + 1) % 3]}).second) return false;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) return false;
  return !edges.empty();
}

float ball(int x, int y, int z) { return static_cast<float>(std::sqrt(x * x + y * y + z * z) - 17.3); }

TEST(MarchingTetrahedra, a_ball_is_closed_wound_outward_and_has_its_volume) {
  const auto cells = cells_of(20, ball);
  const TriangleMesh mesh = marching_tetrahedra(cells, 0.5, {3, -4, 5});
  EXPECT_TRUE(is_closed_and_oriented(mesh));
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(17.3 * 0.5, 3);
  EXPECT_NEAR(moments(mesh).volume_mm3, exact, 0.01 * exact);
  EXPECT_NEAR(norm(moments(mesh).centroid_mm() - Vec3{3, -4, 5}), 0, 1e-3);
}

TEST(MarchingTetrahedra, a_linear_field_is_meshed_exactly) {
  // The zero of max(|x|,|y|,|z|) - r is linear in all tetrahedra away from the cube's edges.
  const auto plane = [](int x, int, int) { return static_cast<float>(x) - 0.25F; };
  for (const Vec3& v : marching_tetrahedra(cells_of(4, plane), 2, {}).vertices) EXPECT_DOUBLE_EQ(v.x, 0.5);
}

TEST(MarchingTetrahedra, random_signs_are_closed_and_oriented_whatever_the_case) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    std::map<std::array<int, 3>, float> values;
    const auto field = [&](int x, int y, int z) {
      if (std::max({std::abs(x), std::abs(y), std::abs(z)}) >= 5) return 1.0F;
      auto [at, is_new] = values.try_emplace({x, y, z});
      if (is_new) at->second = std::uniform_real_distribution<float>(0.05F, 1)(random) * (random() % 2 ? 1.0F : -1.0F);
      return at->second;
    };
    EXPECT_TRUE(is_closed_and_oriented(marching_tetrahedra(cells_of(5, field), 1, {})));
  }
}

TEST(MarchingTetrahedra, cells_far_from_the_origin_give_the_same_mesh) {
  auto cells = cells_of(20, ball);
  const TriangleMesh here = marching_tetrahedra(cells, 1, {});
  for (CornerCell& cell : cells) cell.ijk = {cell.ijk[0] + 2'000'000'000, cell.ijk[1] - 2'000'000'000, cell.ijk[2]};
  EXPECT_EQ(marching_tetrahedra(cells, 1, {}).triangles, here.triangles);
}

TEST(MarchingTetrahedra, no_cells_give_an_empty_mesh) { EXPECT_TRUE(marching_tetrahedra({}, 1, {}).triangles.empty()); }

}  // namespace
}  // namespace aplomb
