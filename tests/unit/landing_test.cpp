#include "aplomb/balance/landing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "support/shapes.h"

namespace aplomb {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<Landing> landings_of(const TriangleMesh& mesh) { return landings(mesh, moments(mesh), 0.01).value(); }

double total_chance(const std::vector<Landing>& found) {
  return std::accumulate(found.begin(), found.end(), 0.0, [](double sum, const Landing& l) { return sum + l.chance; });
}

/// The solid angle of an a x b rectangle seen from straight above its centre at distance d, over 4 pi.
double chance_of_rectangle(double a, double b, double d) {
  return std::asin(a * b / std::sqrt((a * a + 4 * d * d) * (b * b + 4 * d * d))) / pi;
}

TEST(Landings, OfABoxAreTheSolidAnglesOfItsFaces) {
  const std::vector<Landing> found = landings_of(test::box({1, 2, 3}, {21, 32, 53}));
  ASSERT_EQ(found.size(), 6u);
  for (const Landing& landing : found) {
    const Vec3 size{20, 30, 50};
    int axis = 0;
    while (std::abs(landing.face.up[axis]) < 0.5) ++axis;
    const double a = size[(axis + 1) % 3], b = size[(axis + 2) % 3], d = size[axis] / 2;
    EXPECT_NEAR(landing.chance, chance_of_rectangle(a, b, d), 1e-12);
    EXPECT_NEAR(landing.face.tip_rad, std::atan2(std::min(a, b) / 2, d), 2e-3);
    EXPECT_NEAR(landing.face.com_height_mm, d, 1e-9);
  }
  EXPECT_NEAR(total_chance(found), 1, 1e-12);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](auto& a, auto& b) { return a.chance > b.chance; }));
}

TEST(Landings, OfARegularTetrahedronAreAQuarterEach) {
  const std::vector<Landing> found = landings_of(test::tetrahedron({9, 9, 9}, {9, -9, -9}, {-9, 9, -9}, {-9, -9, 9}));
  ASSERT_EQ(found.size(), 4u);
  for (const Landing& landing : found) EXPECT_NEAR(landing.chance, 0.25, 1e-12);
}

/// Its ends are so far over that it falls from them onto a side: they pass their chances on.
TEST(Landings, OfAFaceItCannotRestOnGoToTheFaceItRollsOnto) {
  const std::vector<Landing> found = landings_of(test::leaning_prism(10, 12, 40, 30));
  for (const Landing& landing : found) EXPECT_LT(std::abs(landing.face.up.z), 0.99);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_NEAR(total_chance(found), 1, 1e-12);
  const double slope = std::atan2(30, 40);
  for (const Landing& landing : found)  // the ends roll onto the slanted sides, which thus hold more than their own
    EXPECT_NEAR(std::abs(landing.face.up.x), std::abs(landing.face.up.y) < 0.5 ? std::cos(slope) : 0, 1e-9);
}

TEST(Landings, TurnWithTheSolid) {
  const TriangleMesh mesh = test::leaning_prism(14, 12, 30, 12);
  const std::vector<Landing> a = landings_of(mesh);
  ASSERT_EQ(a.size(), 6u);
  for (int k = 0; k < 50; ++k) {
    const Affine3 turn = test::rotation({1, 2, 3.0 - k}, 0.7 + k);
    TriangleMesh turned = mesh;
    for (Vec3& v : turned.vertices) v = turn.linear * v;
    const std::vector<Landing> b = landings_of(turned);
    ASSERT_EQ(b.size(), 6u) << k;
    for (const Landing& landing : a) {
      const Vec3 up = turn.linear * landing.face.up;
      const auto same = std::find_if(b.begin(), b.end(), [&](const Landing& l) { return dot(l.face.up, up) > 0.9999; });
      ASSERT_NE(same, b.end());
      EXPECT_NEAR(same->chance, landing.chance, 1e-9);
      EXPECT_NEAR(same->face.tip_rad, landing.face.tip_rad, 1e-4);
    }
  }
}

/// Without solid angles: directions drawn at random, each counted for the face that it leaves the solid by.
TEST(Landings, AgreeWithDirectionsDrawnAtRandom) {
  const TriangleMesh mesh = test::box({0, 0, 0}, {20, 30, 26});
  const Vec3 com = moments(mesh).centroid_mm();
  const std::vector<Landing> found = landings_of(mesh);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<int> hits(found.size());
  const int throws = 20000;
  for (int i = 0; i < throws; ++i) {
    const Vec3 down{normal(random), normal(random), normal(random)};
    double first = 1e9;  // the face that the ray from the centre of mass meets
    std::size_t face = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double along = -dot(found[k].face.up, down);
      if (along <= 0 || found[k].face.com_height_mm / along >= first) continue;
      first = found[k].face.com_height_mm / along;
      face = k;
    }
    ++hits[face];
  }
  EXPECT_EQ(com, (Vec3{10, 15, 13}));
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double sigma = std::sqrt(found[k].chance * (1 - found[k].chance) / throws);
    EXPECT_NEAR(double(hits[k]) / throws, found[k].chance, 5 * sigma);
  }
}

TEST(Landings, AreTheSameToTheBitInWhateverOrderTheVerticesCome) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> between(-1, 1);
  TriangleMesh scattered = test::sphere({}, 20, 3);
  for (Vec3& v : scattered.vertices) v = (1 + 0.2 * between(random)) * v;
  for (const TriangleMesh& mesh :
       {scattered, test::box({1, 2, 3}, {21, 32, 53}), test::leaning_prism(28, 20, 60, 30)}) {
    const Moments mass = moments(mesh);
    const std::vector<Landing> expected = landings(mesh, mass, 0.01).value();
    for (int round = 0; round < 20; ++round) {
      TriangleMesh shuffled = mesh;  // the hull asks for the vertices alone
      std::shuffle(shuffled.vertices.begin(), shuffled.vertices.end(), random);
      const std::vector<Landing> found = landings(shuffled, mass, 0.01).value();
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].chance, expected[i].chance);
        EXPECT_EQ(found[i].face.up, expected[i].face.up);
      }
    }
  }
}

TEST(Landings, OfAFlatMeshAreRefused) {
  TriangleMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  flat.triangles = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_FALSE(landings(flat, Moments{1, {}}, 0.1).has_value());
}

}  // namespace
}  // namespace aplomb
