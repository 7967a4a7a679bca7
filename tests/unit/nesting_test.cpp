// What touches and what encloses what, against every triangle of every component tried.
#include "aplomb/mesh/detail/nesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/soup.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

using detail::Components;
using detail::Enclosure;

/// Boxes and balls that lie apart, touch, cross or are nested, some inside out, some open, on a lattice that makes them
/// meet.
TriangleMesh random_bodies(std::mt19937& random, int count) {
  const auto pick = [&](int below) { return static_cast<double>(random() % static_cast<unsigned>(below)); };
  TriangleMesh all;
  for (int i = 0; i < count; ++i) {
    const Vec3 at{pick(12), pick(12), pick(12)}, size{1 + pick(9), 1 + pick(9), 1 + pick(9)};
    TriangleMesh body = i % 3 == 0 ? test::sphere(at, 1 + pick(5), i % 2 ? 1 : 2) : test::box(at, at + size);
    if (i % 5 == 0) body = reversed(body);
    if (i % 7 == 0) body.triangles.pop_back();
    if (i % 11 == 0) body.triangles.push_back({0, 0, 1});
    all = joined(std::move(all), body);
  }
  return detail::welded(all);
}

bool touch(const TriangleMesh& mesh, const Triangle& s, const Triangle& t) {
  if (std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) != s.end()) return true;
  const auto degenerate = [](const Triangle& u) { return u[0] == u[1] || u[1] == u[2] || u[2] == u[0]; };
  return !degenerate(s) && !degenerate(t) && detail::cross(mesh, s, t);
}

class NestingOfBodies : public testing::TestWithParam<unsigned> {
 protected:
  NestingOfBodies()
      : random_(GetParam()),
        mesh_(random_bodies(random_, 4 + static_cast<int>(GetParam() % 30))),
        edges_(mesh_),
        components_(edge_components(mesh_, edges_)),
        nesting_(mesh_, edges_, components_) {}

  std::uint32_t of(std::size_t triangle) const { return components_.of_triangle[triangle]; }

  /// By a ray from each component's first vertex against all triangles.
  std::vector<std::vector<int>> windings() const {
    std::vector<std::vector<int>> around(components_.count, std::vector<int>(components_.count));
    std::vector<bool> seen(components_.count);
    for (std::size_t first = 0; first < mesh_.triangles.size(); ++first) {
      if (seen[of(first)]) continue;
      seen[of(first)] = true;
      const Vec3 p = mesh_.vertices[mesh_.triangles[first][0]];
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
        if (of(t) != of(first)) around[of(first)][of(t)] += detail::crossing_above(mesh_, mesh_.triangles[t], p);
    }
    return around;
  }

  std::mt19937 random_;
  TriangleMesh mesh_;
  detail::EdgeTable edges_;
  Components components_;
  detail::Nesting nesting_;
};

TEST_P(NestingOfBodies, TouchingOnesAreInOneSet) {
  detail::DisjointSets expected(components_.count);
  for (std::size_t s = 0; s < mesh_.triangles.size(); ++s)
    for (std::size_t t = s + 1; t < mesh_.triangles.size(); ++t)
      if (expected.find(of(s)) != expected.find(of(t)) && touch(mesh_, mesh_.triangles[s], mesh_.triangles[t]))
        expected.join(of(s), of(t));
  auto sets = nesting_.touching({});
  ASSERT_TRUE(sets);
  for (std::uint32_t c = 0; c < components_.count; ++c) EXPECT_EQ(sets->find(c), expected.find(c));
}

TEST_P(NestingOfBodies, EnclosuresAreThoseOfARayAgainstAllTriangles) {
  const auto expected = windings();
  const auto enclosing = nesting_.enclosures({});
  auto told = nesting_.windings({});
  ASSERT_TRUE(enclosing && told);
  detail::DisjointSets sets(components_.count);
  for (std::uint32_t c = 0; c < components_.count; ++c) {
    std::vector<int> around(components_.count);
    for (const Enclosure& e : (*enclosing)[c]) around[e.component] = e.winding;
    EXPECT_EQ(around, expected[c]);
    EXPECT_TRUE(std::is_sorted((*enclosing)[c].begin(), (*enclosing)[c].end(),
                               [](Enclosure a, Enclosure b) { return a.component < b.component; }));
    EXPECT_EQ(told->sums[c], std::accumulate(expected[c].begin(), expected[c].end(), 0));
    for (const Enclosure& e : (*enclosing)[c]) sets.join(c, e.component);
  }
  for (std::uint32_t c = 0; c < components_.count; ++c) EXPECT_EQ(told->sets.find(c), sets.find(c));
}

TEST_P(NestingOfBodies, ConnectedOnesTouchOrAreEnclosed) {
  const auto around = windings();
  auto expected = nesting_.touching({});
  auto connected = nesting_.connected({});
  ASSERT_TRUE(expected && connected);
  for (std::uint32_t c = 0; c < components_.count; ++c)
    for (std::uint32_t other = 0; other < components_.count; ++other)
      if (around[c][other] != 0) expected->join(c, other);
  for (std::uint32_t c = 0; c < components_.count; ++c) EXPECT_EQ(connected->find(c), expected->find(c));
}

INSTANTIATE_TEST_SUITE_P(Random, NestingOfBodies, testing::Range(0U, 40U));

}  // namespace
}  // namespace aplomb
