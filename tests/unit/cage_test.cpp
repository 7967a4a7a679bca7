#include "aplomb/deform/cage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "aplomb/deform/surface_motion.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb::test {
namespace {

Cage cage_of(const SolidMesh& solid, std::size_t samples = 20000) {
  auto cage = build_cage(solid, {.wall_mm = 2, .samples = samples});
  EXPECT_TRUE(cage) << cage.error().message;
  return std::move(*cage);
}

Moments moments_of(const std::vector<SolidSample>& samples, const TetMesh& mesh, double share_of_carvable) {
  Moments sum;
  for (const SolidSample& s : samples)
    sum += (1 - share_of_carvable * (1 - s.carvable)) * s.volume_mm3 * Moments{1, s.at.position(mesh, mesh.vertices)};
  return sum;
}

std::vector<Vec3> mapped(const std::vector<Vec3>& points, const Affine3& map) {
  std::vector<Vec3> out;
  for (const Vec3& p : points) out.push_back(map * p);
  return out;
}

TEST(Cage, HoldsEveryVertexOfASolidWhereItIs) {
  const SolidMesh solid = solid_of(with_void(torus({3, 4, 10}, 30, 8, 60, 30), sphere({33, 4, 10}, 4, 2)));
  const Cage cage = cage_of(solid);
  for (const Vec3& vertex : solid.mesh().vertices) {
    const auto point = cage.embed(vertex);
    ASSERT_TRUE(point);
    EXPECT_LT(norm(point->position(cage.mesh(), cage.mesh().vertices) - vertex), 1e-9);
    for (const double weight : point->weights) EXPECT_GE(weight, -1e-12);
  }
  EXPECT_FALSE(cage.embed({3, 4, 10})) << "the middle of the ring";
  EXPECT_FALSE(cage.embed({300, 4, 10}));
}

TEST(Cage, IsMadeOfSixthsOfCubes) {
  const Cage cage = cage_of(solid_of(sphere({}, 20, 4)));
  const double expected = std::pow(cage.cube_mm(), 3) / 6;
  for (const TetMesh::Tet& t : cage.mesh().tets) {
    const auto& v = cage.mesh().vertices;
    EXPECT_NEAR(signed_volume(v[t[0]], v[t[1]], v[t[2]], v[t[3]]), expected, 1e-9 * expected);
  }
  for (const double share : cage.solid_share()) {
    EXPECT_GE(share, 0.05);
    EXPECT_LE(share, 1);
  }
}

TEST(Cage, CarriesTheSolidsMomentsAndWhatOfItMayBeCarved) {
  const SolidMesh solid = solid_of(sphere({5, 6, 30}, 20, 5));
  const Cage cage = cage_of(solid, 60000);
  const Moments all = moments_of(cage.samples(), cage.mesh(), 0);
  EXPECT_NEAR(all.volume_mm3, solid.moments().volume_mm3, 1e-6 * all.volume_mm3);
  EXPECT_LT(norm(all.centroid_mm() - Vec3{5, 6, 30}), 0.01);
  const Moments carvable = moments_of(cage.samples(), cage.mesh(), 1);
  EXPECT_NEAR(carvable.volume_mm3, 4.0 / 3 * M_PI * 18 * 18 * 18, 0.02 * carvable.volume_mm3);
}

TEST(Cage, DoublesTheCubesThatTwoLegsShare) {
  const double side = 20, gap = 3;
  const TriangleMesh legs =
      joined(box({0, 0, 0}, {side, side, 60}), box({side + gap, 0, 0}, {2 * side + gap, side, 60}));
  const Cage apart = cage_of(solid_of(legs), 60000);  // pieces of 0.93 mm
  std::set<std::uint32_t> left, right;
  for (const SolidSample& s : apart.samples()) {
    const bool is_left = s.at.position(apart.mesh(), apart.mesh().vertices).x < side + gap / 2;
    for (const std::uint32_t v : apart.mesh().tets[s.at.tet]) (is_left ? left : right).insert(v);
  }
  for (const std::uint32_t v : left) EXPECT_FALSE(right.contains(v));
  EXPECT_GT(apart.cube_mm(), gap) << "or they would not share any";
}

TEST(Cage, JoinsWhatTheSolidJoins) {
  const Cage cage = cage_of(solid_of(torus({}, 30, 8, 60, 30)));
  std::vector<std::uint32_t> reached{0};
  std::vector<std::vector<std::uint32_t>> tets_of(cage.mesh().vertices.size());
  for (std::uint32_t t = 0; t < cage.mesh().tets.size(); ++t)
    for (const std::uint32_t v : cage.mesh().tets[t]) tets_of[v].push_back(t);
  std::set<std::uint32_t> seen{0};
  while (!reached.empty()) {
    const std::uint32_t v = reached.back();
    reached.pop_back();
    for (const std::uint32_t t : tets_of[v])
      for (const std::uint32_t w : cage.mesh().tets[t])
        if (seen.insert(w).second) reached.push_back(w);
  }
  EXPECT_EQ(seen.size(), cage.mesh().vertices.size());
}

TEST(Cage, StopsWhenAskedTo) {
  const auto cage = build_cage(solid_of(sphere({}, 20, 3)), {}, Job([](double, std::string_view) { return false; }));
  ASSERT_FALSE(cage);
  EXPECT_EQ(cage.error().code, ErrorCode::cancelled);
}

TEST(SurfaceMotion, ReproducesAffineMaps) {
  const SolidMesh solid = solid_of(torus({3, 4, 10}, 30, 8, 60, 30));
  const Cage cage = cage_of(solid);
  const auto motion = SurfaceMotion::make(cage, solid.mesh());
  ASSERT_TRUE(motion);
  const Affine3 map{{{{{1.1, 0.2, 0}, {-0.1, 0.9, 0.3}, {0, 0.1, 1.2}}}}, {7, -8, 9}};
  const TriangleMesh moved = motion->moved(mapped(cage.mesh().vertices, map));
  EXPECT_EQ(moved.triangles, solid.mesh().triangles);
  for (std::size_t v = 0; v < moved.vertices.size(); ++v)
    EXPECT_LT(norm(moved.vertices[v] - map * solid.mesh().vertices[v]), 1e-5);
}

TEST(SurfaceMotion, LeavesWhatDoesNotMoveToTheBit) {
  const SolidMesh solid = solid_of(box({0, 0, 0}, {20, 20, 80}));
  const Cage cage = cage_of(solid);
  const auto motion = SurfaceMotion::make(cage, solid.mesh());
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->moved(cage.mesh().vertices), solid.mesh());
  std::vector<Vec3> bent = cage.mesh().vertices;
  for (Vec3& v : bent)
    if (v.z > 30) v.x += 0.01 * (v.z - 30) * (v.z - 30);
  const TriangleMesh moved = motion->moved(bent);
  for (std::size_t v = 0; v < moved.vertices.size(); ++v) {
    const Vec3 given = solid.mesh().vertices[v];
    if (given.z < 20) {
      EXPECT_EQ(moved.vertices[v], given);
    }
  }
}

TEST(SurfaceMotion, IsSmootherThanTheTetrahedraAre) {
  const SolidMesh solid = solid_of(cylinder({}, 10, 100, 40));
  const Cage cage = cage_of(solid, 5000);
  TriangleMesh line;  // many points up the middle; no surface is needed
  for (int i = 1; i < 1000; ++i) line.vertices.push_back({0.3, 0.2, 0.1 * i});
  const auto motion = SurfaceMotion::make(cage, line);
  ASSERT_TRUE(motion);
  std::vector<Vec3> bent = cage.mesh().vertices;
  for (Vec3& v : bent) v.x += 0.002 * v.z * v.z;
  const TriangleMesh moved = motion->moved(bent);
  double most_linear = 0, most_phong = 0;  // change of slope from one piece of 1 mm to the next
  const auto linear = [&](int i) {
    return cage.embed(line.vertices[static_cast<std::size_t>(i)])->position(cage.mesh(), bent).x;
  };
  const auto phong = [&](int i) { return moved.vertices[static_cast<std::size_t>(i)].x; };
  for (int i = 200; i < 800; i += 10) {
    most_linear = std::max(most_linear, std::abs(linear(i + 10) - 2 * linear(i) + linear(i - 10)));
    most_phong = std::max(most_phong, std::abs(phong(i + 10) - 2 * phong(i) + phong(i - 10)));
  }
  EXPECT_LT(most_phong, 0.6 * most_linear);
}

}  // namespace
}  // namespace aplomb::test
