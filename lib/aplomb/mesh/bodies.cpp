#include "aplomb/mesh/bodies.h"

#include <algorithm>

#include "aplomb/mesh/detail/crossings.h"
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

std::vector<TriangleMesh> split_prints(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  const TriangleMesh whole = detail::welded(mesh);  // the same triangles in the same order
  const detail::Components components = edge_components(whole, detail::EdgeTable(whole));
  if (components.count == 1) return {mesh};
  const detail::TriangleTree tree(whole);
  detail::DisjointSets prints(components.count);
  for (const auto [low, high] : meeting_components(whole, tree, components)) prints.join(low, high);
  const auto enclosing = enclosures(whole, tree, components);
  for (std::uint32_t c = 0; c < components.count; ++c)
    for (const detail::Enclosure& e : enclosing[c]) prints.join(c, e.component);

  std::vector<std::uint32_t> number(components.count);
  std::uint32_t count = 0;
  for (std::uint32_t c = 0; c < components.count; ++c) {
    const std::uint32_t root = prints.find(c);  // the smallest member
    number[c] = root == c ? count++ : number[root];
  }
  if (count == 1) return {mesh};
  std::vector<std::vector<std::uint32_t>> triangles(count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) triangles[number[components.of_triangle[t]]].push_back(t);
  std::vector<std::uint32_t> places(mesh.vertices.size());
  std::vector<TriangleMesh> parts;
  parts.reserve(count);
  for (const auto& members : triangles) parts.push_back(part_of(mesh, members, places));
  return parts;
}

}  // namespace aplomb
