#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/mesh/marching_tetrahedra.h"
#include "aplomb/mesh/mass_properties.h"
#include "aplomb/mesh/simplify.h"
#include "aplomb/mesh/solid_mesh.h"
#include "aplomb/shell/simplify_surface.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

using adapters::SurfaceDistance;

double area_mm2(const TriangleMesh& mesh) {
  double doubled = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    doubled += norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
  return doubled / 2;
}

/// V - E + F of a closed triangle mesh: 2 - 2 genus.
std::ptrdiff_t euler_number(const TriangleMesh& mesh) {
  return std::ptrdiff_t(mesh.vertices.size()) - std::ptrdiff_t(mesh.triangles.size()) / 2;
}

/// The farthest of points spread over the triangles of `from`.
double farthest_mm(const TriangleMesh& from, const TriangleMesh& to) {
  constexpr int steps = 6;
  const SurfaceDistance distance(to);
  double farthest = 0;
  for (const auto& [a, b, c] : from.triangles)
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const Vec3 p =
            (double(i) * from.vertices[a] + double(j) * from.vertices[b] + double(steps - i - j) * from.vertices[c]) /
            steps;
        farthest = std::max(farthest, distance.closest(p).distance_mm);
      }
  return farthest;
}

/// The zero of a field on a lattice of spacing 1, as carving meshes it: no value within 0.05 of zero, slivers and all.
template <class Field>
TriangleMesh meshed(int size, Field field) {
  std::vector<CornerCell> cells;
  for (int k = -size; k < size; ++k)
    for (int j = -size; j < size; ++j)
      for (int i = -size; i < size; ++i) {
        CornerCell cell{{i, j, k}, {}};
        for (int c = 0; c < 8; ++c) {
          const auto value = static_cast<float>(field(Vec3(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1))));
          cell.values[c] = std::abs(value) < 0.05F ? 0.05F : value;
        }
        cells.push_back(cell);
      }
  return rounded_to_float(marching_tetrahedra(cells, 1, {0.1, 0.2, 0.3}));
}

TriangleMesh meshed_ball() {
  return meshed(16, [](Vec3 p) { return norm(p) - 13.3; });
}
TriangleMesh meshed_torus() {
  return meshed(16, [](Vec3 p) { return std::hypot(std::hypot(p.x, p.y) - 9.7, p.z) - 4.1; });
}
Result<std::vector<std::uint32_t>> nothing(const TriangleMesh&, const Job&) { return std::vector<std::uint32_t>{}; }

/// A half ball: a flat, oblique cut with a sharp rim.
TriangleMesh meshed_half_ball() {
  const Vec3 up = normalized({0.3, -0.5, 0.8});
  return meshed(16, [&](Vec3 p) { return std::max(norm(p) - 13.3, dot(up, p) - 1.7); });
}

TEST(Simplify, a_marched_surface_stays_a_solid_of_its_genus_with_a_fraction_of_the_triangles) {
  for (const TriangleMesh& fine : {meshed_ball(), meshed_torus(), meshed_half_ball()}) {
    const TriangleMesh coarse = simplify(fine, 0.05)->mesh;
    const auto check = check_solid(coarse);
    EXPECT_TRUE(check->solid) << describe(check->defects);
    EXPECT_EQ(euler_number(coarse), euler_number(fine));
    EXPECT_LT(coarse.triangles.size(), fine.triangles.size() / 4);
  }
}

TEST(Simplify, no_given_vertex_is_farther_than_the_deviation_from_the_triangle_named_for_it) {
  for (const double deviation : {0.02, 0.1, 0.5}) {
    const TriangleMesh fine = meshed_half_ball();
    const SimplifiedMesh coarse = *simplify(fine, deviation);
    ASSERT_EQ(coarse.triangle_near.size(), fine.vertices.size());
    for (std::size_t v = 0; v < fine.vertices.size(); ++v) {
      TriangleMesh one{coarse.mesh.vertices, {coarse.mesh.triangles.at(coarse.triangle_near[v])}};
      const auto [a, b, c] = one.triangles[0];
      one = {{one.vertices[a], one.vertices[b], one.vertices[c]}, {{0, 1, 2}}};
      EXPECT_LE(SurfaceDistance(one).closest(fine.vertices[v]).distance_mm, deviation * (1 + 1e-9));
    }
  }
}

TEST(Simplify, between_the_vertices_too_both_surfaces_stay_within_twice_the_deviation) {
  for (const TriangleMesh& fine : {meshed_ball(), meshed_torus(), meshed_half_ball()}) {
    const TriangleMesh coarse = simplify(fine, 0.1)->mesh;
    EXPECT_LE(farthest_mm(fine, coarse), 0.2);
    EXPECT_LE(farthest_mm(coarse, fine), 0.2);
    const double change = std::abs(moments(coarse).volume_mm3 - moments(fine).volume_mm3);
    EXPECT_LE(change, 0.1 * area_mm2(fine));
  }
}

TEST(Simplify, flat_faces_need_few_triangles) {
  const TriangleMesh fine = meshed(12, [](Vec3 p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - 9.5;
  });
  const TriangleMesh coarse = simplify(fine, 0.01)->mesh;
  EXPECT_LT(coarse.triangles.size(), 800U);
  EXPECT_GT(fine.triangles.size(), 10'000U);
  EXPECT_NEAR(moments(coarse).volume_mm3, moments(fine).volume_mm3, 0.01 * area_mm2(fine));
}

TEST(Simplify, kept_vertices_stay_with_the_triangles_between_them) {
  const TriangleMesh fine = meshed_torus();
  std::vector<bool> kept(fine.vertices.size());
  for (std::size_t v = 0; v < kept.size(); ++v) kept[v] = fine.vertices[v].x > 5;
  const SimplifiedMesh coarse = *simplify(fine, 0.2, kept);
  std::vector<bool> there(kept.size());
  for (const std::uint32_t v : coarse.given_vertices) there[v] = true;
  for (std::size_t v = 0; v < kept.size(); ++v) EXPECT_TRUE(there[v] || !kept[v]);
  std::set<Triangle> left;
  for (const auto& [a, b, c] : coarse.mesh.triangles)
    left.insert({coarse.given_vertices[a], coarse.given_vertices[b], coarse.given_vertices[c]});
  for (const Triangle& t : fine.triangles) EXPECT_TRUE(left.contains(t) || !kept[t[0]] || !kept[t[1]] || !kept[t[2]]);
}

TEST(Simplify, its_vertices_are_the_given_ones_it_names) {
  const TriangleMesh fine = meshed_ball();
  const SimplifiedMesh coarse = *simplify(fine, 0.1);
  ASSERT_EQ(coarse.given_vertices.size(), coarse.mesh.vertices.size());
  for (std::size_t v = 0; v < coarse.given_vertices.size(); ++v)
    EXPECT_EQ(coarse.mesh.vertices[v], fine.vertices[coarse.given_vertices[v]]);
}

TEST(Simplify, a_tetrahedron_has_nothing_to_lose) {
  const TriangleMesh least = test::tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_EQ(simplify(least, 100)->mesh, least);
}

TEST(Simplify, a_huge_deviation_leaves_a_manifold_of_the_same_genus) {
  const TriangleMesh coarse = simplify(test::torus({}, 10, 3, 60, 30), 1000)->mesh;
  EXPECT_EQ(euler_number(coarse), 0);
  const MeshDefects defects = check_solid(coarse)->defects;
  EXPECT_EQ(defects.open_edges + defects.nonmanifold_edges + defects.nonmanifold_vertices +
                defects.duplicate_triangles + defects.flipped_edges + defects.degenerate_triangles,
            0U);
}

TEST(Simplify, it_stops_when_told_to) {
  for (int last = 1; last <= 3; ++last) {
    int reports = 0;
    const Job job([&](double, std::string_view) { return ++reports < last; });
    const auto result = simplify(meshed_ball(), 0.1, {}, job);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
  }
}

TEST(SimplifiedSurface, what_is_spoilt_is_done_again_with_the_given_triangles_round_it) {
  const TriangleMesh fine = meshed_half_ball();
  int rounds = 0;
  const auto too_large_at_top = [&](const TriangleMesh& mesh, const Job&) -> Result<std::vector<std::uint32_t>> {
    ++rounds;
    std::vector<std::uint32_t> spoilt;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      Box3 box;
      for (const std::uint32_t v : mesh.triangles[i]) box.add(mesh.vertices[v]);
      if (box.max.z < -9 && box.diagonal() > 2) spoilt.push_back(i);
    }
    return spoilt;
  };
  const TriangleMesh coarse = *simplified_surface(fine, 0.1, too_large_at_top);
  EXPECT_TRUE(too_large_at_top(coarse, {})->empty());
  EXPECT_TRUE(check_solid(coarse)->solid);
  EXPECT_LT(coarse.triangles.size(), fine.triangles.size() / 2);
  EXPECT_GT(rounds, 2);
}

TEST(SimplifiedSurface, sheets_nearer_than_the_deviation_never_cross) {
  const auto sheets = [](Vec3 p) { return std::max(std::abs(norm(p) - 11) - 1.1, std::abs(p.z) - 7.3); };
  for (const double deviation : {0.3, 1.0, 3.0}) {
    const TriangleMesh coarse = *simplified_surface(meshed(14, sheets), deviation, nothing);
    const auto check = check_solid(coarse);
    EXPECT_TRUE(check->solid) << deviation << ": " << describe(check->defects);
  }
}

TEST(SimplifiedSurface, one_thread_and_many_give_the_same_mesh) {
  const TriangleMesh fine = meshed_torus();
  const auto on = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return *simplified_surface(fine, 1.0, nothing);
  };
  const TriangleMesh alone = on(1);
  EXPECT_EQ(on(2), alone);
  EXPECT_EQ(on(8), alone);
}

}  // namespace
}  // namespace aplomb
