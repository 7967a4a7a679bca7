#include "aplomb/mesh/bodies.h"

#include <algorithm>

#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/nesting.h"
#include "aplomb/mesh/detail/soup.h"

namespace aplomb {
namespace {

/// The given triangles with their vertices in order; `places` is scratch of one entry a vertex, in O(part) time.
TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles,
                     std::vector<std::uint32_t>& places) {
  std::vector<std::uint32_t> used;
  for (const std::uint32_t t : triangles) used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  TriangleMesh part;
  for (const std::uint32_t v : used) {
    places[v] = static_cast<std::uint32_t>(part.vertices.size());
    part.vertices.push_back(mesh.vertices[v]);
  }
  for (const std::uint32_t t : triangles) {
    const auto [a, b, c] = mesh.triangles[t];
    part.triangles.push_back({places[a], places[b], places[c]});
  }
  return part;
}

}  // namespace

Result<PrintNumbers> number_prints(const TriangleMesh& mesh, const Job& job) {
  if (mesh.triangles.empty()) return PrintNumbers{};
  const Result<TriangleMesh> welded = detail::welded(mesh, job.part(0, 0.25));
  if (!welded) return tl::unexpected(welded.error());
  const TriangleMesh& whole = *welded;  // the same triangles in the same order
  const Pulse pulse(job, 0.3, "check");
  const detail::EdgeTable edges(whole, pulse);
  detail::Components components = edge_components(whole, edges, pulse);
  if (pulse.stopped()) return cancelled();
  if (components.count == 1) return PrintNumbers{std::move(components.of_triangle), 1};
  detail::Nesting nesting(whole, edges, components, pulse);
  if (pulse.stopped()) return cancelled();
  auto sets = nesting.connected(job.part(0.5, 1));
  if (!sets) return tl::unexpected(sets.error());
  return detail::numbered(std::move(components), *sets);
}

Result<std::vector<TriangleMesh>> split_prints(const TriangleMesh& mesh, const Job& job) {
  std::vector<TriangleMesh> parts;
  const auto prints = number_prints(mesh, job.part(0, 0.8));
  if (!prints) return tl::unexpected(prints.error());
  if (prints->count == 1) return std::vector{mesh};
  std::vector<std::vector<std::uint32_t>> triangles(prints->count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) triangles[prints->of_triangle[t]].push_back(t);
  std::vector<std::uint32_t> places(mesh.vertices.size());
  parts.reserve(prints->count);
  for (const auto& members : triangles) {
    if (parts.size() % 65536 == 0 && !job.report(0.8 + 0.2 * double(parts.size()) / prints->count, "check"))
      return cancelled();
    parts.push_back(part_of(mesh, members, places));
  }
  return parts;
}

}  // namespace aplomb
