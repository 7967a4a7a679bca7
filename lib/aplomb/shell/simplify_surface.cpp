#include "aplomb/shell/simplify_surface.h"

#include <algorithm>
#include <vector>

#include "aplomb/adapters/cgal/exact_predicates.h"
#include "aplomb/adapters/meshoptimizer/simplify.h"
#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/detail/triangle_tree.h"

namespace aplomb {
namespace {

constexpr int most_rounds = 10;
constexpr int rings = 6;  // of fine triangles kept round a spoilt place

using Marks = std::vector<bool>;  // of vertices

void mark_all(const Triangle& t, Marks& marks) {
  for (const std::uint32_t v : t) marks[v] = true;
}

/// Edges that are not shared by two triangles in opposite directions, and degenerate triangles.
bool mark_bad_topology(const TriangleMesh& mesh, Marks& marks, std::vector<bool>& degenerate) {
  bool any = false;
  degenerate.assign(mesh.triangles.size(), false);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (!adapters::are_collinear(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c])) continue;
    any = degenerate[i] = true;
    mark_all(mesh.triangles[i], marks);
  }
  detail::EdgeTable(mesh).for_each([&](std::uint32_t low, std::uint32_t high, std::span<const detail::Corner> corners) {
    if (corners.size() == 2) return;
    any = marks[low] = marks[high] = true;
  });
  return any;
}

/// Vertices where two fans of triangles meet: a collapse pinched the surface.
bool mark_pinched(const TriangleMesh& mesh, Marks& marks) {
  std::vector<std::uint32_t> fan_triangles(mesh.vertices.size()), turns(mesh.vertices.size());
  std::vector<std::uint32_t> next(3 * mesh.triangles.size());  // corner -> corner at the same vertex, one edge on
  detail::EdgeTable(mesh).for_each([&](std::uint32_t low, std::uint32_t, std::span<const detail::Corner> corners) {
    if (corners.size() != 2) return;
    for (int side = 0; side < 2; ++side) {
      const detail::Corner leaving = corners[side], arriving = corners[1 - side];
      next[leaving] = detail::next_corner(arriving);  // both at the vertex that `leaving` starts from
    }
    static_cast<void>(low);
  });
  bool any = false;
  std::vector<bool> seen(next.size());
  std::vector<bool> has_fan(mesh.vertices.size());
  for (detail::Corner start = 0; start < next.size(); ++start) {
    if (seen[start]) continue;
    const std::uint32_t vertex = detail::vertex_at(mesh, start);
    if (has_fan[vertex]) any = marks[vertex] = true;
    has_fan[vertex] = true;
    for (detail::Corner c = start; !seen[c]; c = next[c]) seen[c] = true;
  }
  return any;
}

/// Collapsing leaves fins: pairs of triangles with the same corners, back to back. Without both, the surface is whole.
void remove_fins(std::vector<Triangle>& triangles) {
  std::vector<std::pair<Triangle, std::size_t>> order;
  for (std::size_t i = 0; i < triangles.size(); ++i) order.emplace_back(detail::sorted(triangles[i]), i);
  std::ranges::sort(order);
  std::vector<bool> fin(triangles.size());
  for (std::size_t i = 0; i + 1 < order.size(); ++i)
    if (order[i].first == order[i + 1].first) {
      fin[order[i].second] = fin[order[i + 1].second] = true;
      ++i;
    }
  std::size_t next = 0;
  std::erase_if(triangles, [&](const Triangle&) { return fin[next++]; });
}

Result<bool> mark_crossings(const TriangleMesh& mesh, const std::vector<bool>& degenerate, Marks& marks,
                            const Job& job) {
  const auto crossing = detail::crossing_triangles(mesh, detail::TriangleTree(mesh), degenerate, job);
  if (!crossing) return tl::unexpected(crossing.error());
  for (std::size_t i = 0; i < crossing->size(); ++i)
    if ((*crossing)[i]) mark_all(mesh.triangles[i], marks);
  return std::ranges::find(*crossing, true) != crossing->end();
}

void grow(const TriangleMesh& fine, Marks& marks) {
  for (int ring = 0; ring < rings; ++ring) {
    Marks grown = marks;
    for (const Triangle& t : fine.triangles)
      if (marks[t[0]] || marks[t[1]] || marks[t[2]]) mark_all(t, grown);
    marks = std::move(grown);
  }
}

/// Marks the vertices of all that will not do; false: nothing.
Result<bool> mark_spoilt(const TriangleMesh& coarse, const FindSpoilt& find_spoilt, Marks& marks, const Job& job) {
  std::vector<bool> degenerate;
  bool any = mark_bad_topology(coarse, marks, degenerate);
  if (!any) any = mark_pinched(coarse, marks);
  const auto crossings = mark_crossings(coarse, degenerate, marks, job.part(0, 0.5));
  if (!crossings || any || *crossings) return crossings ? Result<bool>(true) : crossings;
  const auto spoilt = find_spoilt(coarse, job.part(0.5, 1));
  if (!spoilt) return tl::unexpected(spoilt.error());
  for (const std::uint32_t i : *spoilt) mark_all(coarse.triangles[i], marks);
  return !spoilt->empty();
}

}  // namespace

Result<TriangleMesh> simplified_surface(const TriangleMesh& fine, double deviation_mm, const FindSpoilt& find_spoilt,
                                        const Job& job) {
  Marks kept_fine(fine.vertices.size(), false);
  for (int round = 0; round < most_rounds; ++round) {
    const Job part = job.part(double(round) / most_rounds, (round + 1.0) / most_rounds);
    if (!part.report(0, "simplify the shell")) return cancelled();
    TriangleMesh coarse{fine.vertices, {}};
    std::vector<Triangle> free;
    for (const Triangle& t : fine.triangles)
      (kept_fine[t[0]] || kept_fine[t[1]] || kept_fine[t[2]] ? coarse.triangles : free).push_back(t);
    const std::vector<Triangle> collapsed = adapters::simplified(fine.vertices, free, deviation_mm);
    coarse.triangles.insert(coarse.triangles.end(), collapsed.begin(), collapsed.end());
    remove_fins(coarse.triangles);
    Marks marks(fine.vertices.size(), false);
    const auto spoilt = mark_spoilt(coarse, find_spoilt, marks, part);
    if (!spoilt) return tl::unexpected(spoilt.error());
    if (!*spoilt) return detail::submesh(coarse, [](std::uint32_t) { return true; });
    grow(fine, marks);
    for (std::size_t v = 0; v < marks.size(); ++v)
      if (marks[v]) kept_fine[v] = true;
  }
  return fine;
}

}  // namespace aplomb
