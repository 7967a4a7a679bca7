#include "aplomb/mesh/detail/crossings.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>
#include <set>

#include "aplomb/adapters/cgal/exact_predicates.h"

namespace aplomb::detail {
namespace {

using adapters::Corners;

constexpr std::uint32_t leaves_a_step = 4096;  // about 15 ms: steps bound the wait for a cancel, whatever the threads

Corners corners_of(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// Strictly all on one side of the plane of `a`.
template <class... Points>
bool on_one_side(const Corners& a, Vec3 first, Points... others) {
  const int side = adapters::orientation(a[0], a[1], a[2], first);
  return side != 0 && ((adapters::orientation(a[0], a[1], a[2], others) == side) && ...);
}

/// Turned so that the shared vertex, or the one that is not shared, comes first.
Triangle turned(const Triangle& t, unsigned first) { return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]}; }

/// +1 or -1 when the upward ray from p leaves or enters through the triangle, p moved by (-eps^2, eps, 0) so
/// that it meets no edge; else 0.
int crossing_above(const Corners& t, Vec3 p) {
  int turns = 0;  // of the triangle's projection round p
  for (int i = 0; i < 3; ++i) {
    const Vec3 from = t[i], to = t[(i + 1) % 3];
    if ((from.y > p.y) == (to.y > p.y)) continue;
    const bool rises = to.y > p.y;
    const bool right_of_p =
        rises ? adapters::orientation_xy(from, to, p) >= 0 : adapters::orientation_xy(to, from, p) >= 0;
    if (right_of_p) turns += rises ? 1 : -1;
  }
  if (turns == 0) return 0;
  return adapters::orientation(t[0], t[1], t[2], p) * turns < 0 ? turns : 0;
}

}  // namespace

bool cross(const TriangleMesh& mesh, const Triangle& s, const Triangle& t) {
  unsigned in_s = 0, in_t = 0;  // the shared vertices, as bits
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j)
      if (s[i] == t[j]) in_s |= 1U << i, in_t |= 1U << j;
  constexpr std::array<unsigned, 8> first_of{0, 0, 1, 2, 2, 1, 0, 0};  // the odd one out of a mask of one or two bits
  if (in_s == 0) {
    const Corners a = corners_of(mesh, s), b = corners_of(mesh, t);
    return !on_one_side(a, b[0], b[1], b[2]) && !on_one_side(b, a[0], a[1], a[2]) && adapters::triangles_meet(a, b);
  }
  const Corners a = corners_of(mesh, turned(s, first_of[in_s])), b = corners_of(mesh, turned(t, first_of[in_t]));
  if (in_s == 7) return false;
  const bool share_one = (in_s & (in_s - 1)) == 0;
  if (share_one)
    return !on_one_side(a, b[1], b[2]) && !on_one_side(b, a[1], a[2]) &&
           (adapters::triangle_meets_segment(a, b[1], b[2]) || adapters::triangle_meets_segment(b, a[1], a[2]));
  return adapters::orientation(a[0], a[1], a[2], b[0]) == 0 && adapters::on_same_side(a[1], a[2], a[0], b[0]);
}

Result<std::size_t> count_crossings(const TriangleMesh& mesh, const TriangleTree& tree,
                                    const std::vector<bool>& skipped, const Job& job) {
  std::size_t crossings = 0;
  for (std::uint32_t first = 0; first < tree.leaves() && crossings < most_crossings; first += leaves_a_step) {
    if (!job.report(static_cast<double>(first) / tree.leaves(), "check")) return cancelled();
    const tbb::blocked_range<std::uint32_t> step(first, std::min(first + leaves_a_step, tree.leaves()), 64);
    const auto count_in = [&](const tbb::blocked_range<std::uint32_t>& leaves, std::size_t count) {
      for (std::uint32_t leaf = leaves.begin(); leaf != leaves.end(); ++leaf)
        tree.pairs_of_leaf(leaf, [&](std::uint32_t s, std::uint32_t t) {
          count += !skipped[s] && !skipped[t] && cross(mesh, mesh.triangles[s], mesh.triangles[t]);
        });
      return count;
    };
    crossings += tbb::parallel_reduce(step, std::size_t{0}, count_in, std::plus<>());
  }
  return crossings;
}

Result<std::vector<bool>> crossing_triangles(const TriangleMesh& mesh, const TriangleTree& tree,
                                             const std::vector<bool>& skipped, const Job& job) {
  std::vector<bool> crossing(mesh.triangles.size());
  tbb::enumerable_thread_specific<std::vector<std::uint32_t>> found;  // by thread; the union does not depend on it
  for (std::uint32_t first = 0; first < tree.leaves(); first += leaves_a_step) {
    if (!job.report(static_cast<double>(first) / tree.leaves(), "check")) return cancelled();
    const tbb::blocked_range<std::uint32_t> step(first, std::min(first + leaves_a_step, tree.leaves()), 64);
    tbb::parallel_for(step, [&](const tbb::blocked_range<std::uint32_t>& leaves) {
      std::vector<std::uint32_t>& mine = found.local();
      for (std::uint32_t leaf = leaves.begin(); leaf != leaves.end(); ++leaf)
        tree.pairs_of_leaf(leaf, [&](std::uint32_t s, std::uint32_t t) {
          if (!skipped[s] && !skipped[t] && cross(mesh, mesh.triangles[s], mesh.triangles[t]))
            mine.insert(mine.end(), {s, t});
        });
    });
  }
  for (const std::vector<std::uint32_t>& triangles : found)
    for (const std::uint32_t t : triangles) crossing[t] = true;
  return crossing;
}

std::vector<ComponentPair> meeting_components(const TriangleMesh& mesh, const TriangleTree& tree,
                                              const Components& components) {
  std::set<ComponentPair> pairs;
  if (components.count < 2) return {};
  const auto degenerate = [&](const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ||
           adapters::are_collinear(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  };
  for (std::uint32_t leaf = 0; leaf < tree.leaves(); ++leaf)
    tree.pairs_of_leaf(leaf, [&](std::uint32_t s, std::uint32_t t) {
      const std::uint32_t a = components.of_triangle[s], b = components.of_triangle[t];
      if (a == b || pairs.contains({std::min(a, b), std::max(a, b)})) return;
      const Triangle &first = mesh.triangles[s], &second = mesh.triangles[t];
      const bool share = std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) != first.end();
      if (share || (!degenerate(first) && !degenerate(second) && cross(mesh, first, second)))
        pairs.insert({std::min(a, b), std::max(a, b)});
    });
  return {pairs.begin(), pairs.end()};
}

std::vector<std::vector<Enclosure>> enclosures(const TriangleMesh& mesh, const TriangleTree& tree,
                                               const Components& components) {
  std::vector<std::vector<Enclosure>> all(components.count);
  if (components.count < 2) return all;
  std::uint32_t next = 0;  // components are numbered in the order of their first triangles
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (components.of_triangle[t] != next) continue;
    const Vec3 p = mesh.vertices[mesh.triangles[t][0]];
    const auto x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
    std::vector<Enclosure> hits;
    tree.for_each(
        [&](const FloatBox& box) {
          return box.min[0] <= x && x <= box.max[0] && box.min[1] <= y && y <= box.max[1] && z <= box.max[2];
        },
        [&](std::uint32_t other) {
          const std::uint32_t component = components.of_triangle[other];
          if (component == next) return;
          const int crossing = crossing_above(corners_of(mesh, mesh.triangles[other]), p);
          if (crossing != 0) hits.push_back({component, crossing});
        });
    std::sort(hits.begin(), hits.end(), [](Enclosure a, Enclosure b) { return a.component < b.component; });
    for (const Enclosure& hit : hits) {
      if (!all[next].empty() && all[next].back().component == hit.component) all[next].back().winding += hit.winding;
      else all[next].push_back(hit);
    }
    std::erase_if(all[next], [](const Enclosure& e) { return e.winding == 0; });
    ++next;
  }
  return all;
}

std::vector<double> volumes_mm3(const TriangleMesh& mesh, const Components& components) {
  std::vector<double> six_volumes(components.count);
  std::vector<std::uint32_t> origins(components.count, 0xFFFFFFFF);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t component = components.of_triangle[t];
    if (origins[component] == 0xFFFFFFFF) origins[component] = mesh.triangles[t][0];
    const Vec3 origin = mesh.vertices[origins[component]];
    const Vec3 a = mesh.vertices[mesh.triangles[t][0]] - origin, b = mesh.vertices[mesh.triangles[t][1]] - origin,
               c = mesh.vertices[mesh.triangles[t][2]] - origin;
    six_volumes[component] += dot(a, cross(b, c));
  }
  for (double& volume : six_volumes) volume /= 6;
  return six_volumes;
}

}  // namespace aplomb::detail
