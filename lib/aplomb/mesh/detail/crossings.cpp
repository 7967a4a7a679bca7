#include "aplomb/mesh/detail/crossings.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "aplomb/adapters/cgal/exact_predicates.h"

namespace aplomb::detail {
namespace {

using adapters::Corners;

constexpr std::uint32_t most_leaves_a_step =
    4096;  // about 15 ms: steps bound the wait for a cancel, whatever the threads
constexpr std::uint64_t most_pairs_a_step = 1'000'000;  // where many boxes meet

Corners corners_of(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// Strictly all on one side of the plane of `a`.
template <class... Points>
bool on_one_side(const Corners& a, Vec3 first, Points... others) {
  const adapters::OrientedPlane plane(a);
  const int side = plane.side_of(first);
  return side != 0 && ((plane.side_of(others) == side) && ...);
}

/// Turned so that the shared vertex, or the one that is not shared, comes first.
Triangle turned(const Triangle& t, unsigned first) { return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]}; }

/// Calls visit(s, t) for the tree's pairs, on all threads, for as long as more() holds. A step is the larger the fewer
/// pairs the one before it had.
template <class More, class Visit>
Result<void> for_each_pair(const TriangleTree& tree, const Job& job, More&& more, Visit&& visit) {
  const std::uint64_t most_pairs = 30'000'000 + std::uint64_t{100} * BoxTree::leaf_size * tree.leaves();
  std::uint64_t all_pairs = 0;
  std::uint32_t leaves_a_step = 16;
  for (std::uint32_t first = 0; first < tree.leaves() && more();) {
    if (!job.report(static_cast<double>(first) / tree.leaves(), "check")) return cancelled();
    if (all_pairs > most_pairs)
      return fail(ErrorCode::unusable_input,
                  "too many of its triangles lie in one another's boxes to look for crossings; cut long slanted ones, "
                  "leave out surfaces inside others in a modeller, or split the file");
    const std::uint32_t end = std::min(first + leaves_a_step, tree.leaves());
    std::atomic<std::uint64_t> pairs = 0;
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(first, end, std::min(64U, 1 + leaves_a_step / 16)),
                      [&](const tbb::blocked_range<std::uint32_t>& leaves) {
                        std::uint64_t seen = 0;
                        for (std::uint32_t leaf = leaves.begin(); leaf != leaves.end(); ++leaf)
                          tree.pairs_of_leaf(leaf, [&](std::uint32_t s, std::uint32_t t) {
                            ++seen;
                            visit(s, t);
                          });
                        pairs += seen;
                      });
    all_pairs += pairs;
    const std::uint64_t pairs_a_leaf = 1 + pairs / (end - first);
    leaves_a_step = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(
        most_pairs_a_step / pairs_a_leaf, 1, std::min(4 * leaves_a_step, most_leaves_a_step)));
    first = end;
  }
  return {};
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
  return adapters::OrientedPlane(a).side_of(b[0]) == 0 && adapters::on_same_side(a[1], a[2], a[0], b[0]);
}

int crossing_above(const TriangleMesh& mesh, const Triangle& triangle, Vec3 p) {
  const Corners t = corners_of(mesh, triangle);
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
  return adapters::OrientedPlane(t).side_of(p) * turns < 0 ? turns : 0;
}

Result<std::size_t> count_crossings(const TriangleMesh& mesh, const TriangleTree& tree,
                                    const std::vector<bool>& skipped, const Job& job) {
  std::atomic<std::size_t> crossings = 0;
  const Result<void> looked = for_each_pair(
      tree, job, [&] { return crossings < most_crossings; },
      [&](std::uint32_t s, std::uint32_t t) {
        if (!skipped[s] && !skipped[t] && cross(mesh, mesh.triangles[s], mesh.triangles[t])) ++crossings;
      });
  if (!looked) return tl::unexpected(looked.error());
  return std::min<std::size_t>(crossings, most_crossings);
}

Result<std::vector<bool>> crossing_triangles(const TriangleMesh& mesh, const TriangleTree& tree,
                                             const std::vector<bool>& skipped, const Job& job) {
  std::vector<std::atomic<bool>> crossing(mesh.triangles.size());
  const Result<void> looked = for_each_pair(
      tree, job, [] { return true; },
      [&](std::uint32_t s, std::uint32_t t) {
        if (skipped[s] || skipped[t] || (crossing[s] && crossing[t]))
          return;  // whichever was first, the marks are the same
        if (cross(mesh, mesh.triangles[s], mesh.triangles[t])) crossing[s] = crossing[t] = true;
      });
  if (!looked) return tl::unexpected(looked.error());
  return std::vector<bool>(crossing.begin(), crossing.end());
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

double surface_area_mm2(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
  return area;
}

}  // namespace aplomb::detail
