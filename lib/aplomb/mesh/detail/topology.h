#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "aplomb/core/pulse.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// Corner 3 t + i of a mesh is vertex i of triangle t; as an edge, it runs from there to the next corner of
/// t.
using Corner = std::uint32_t;

constexpr Corner next_corner(Corner c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline std::uint32_t vertex_at(const TriangleMesh& mesh, Corner c) { return mesh.triangles[c / 3][c % 3]; }
inline Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// The undirected edges of a mesh, each with the corners that run along it, in linear time.
class EdgeTable {
 public:
  /// Where the pulse stopped, edges are missing.
  explicit EdgeTable(const TriangleMesh& mesh, const Pulse& pulse = {});

  /// Calls visit(low vertex, high vertex, corners in ascending order) for every edge, in a fixed order. An
  /// edge from a vertex to itself is left out; and all that come after the pulse stopped.
  template <class Visit>
  void for_each(Visit&& visit, const Pulse& pulse = {}) const {
    for (std::uint32_t low = 0; low + 1 < starts_.size() && pulse.goes_on(); ++low)
      for (std::size_t first = starts_[low]; first < starts_[low + 1];) {
        std::size_t last = first + 1;
        while (last < starts_[low + 1] && highs_[last] == highs_[first]) ++last;
        visit(low, highs_[first], std::span<const Corner>(corners_.data() + first, last - first));
        first = last;
      }
  }

 private:
  std::vector<std::size_t> starts_;   // of each low vertex
  std::vector<std::uint32_t> highs_;  // sorted within a low vertex
  std::vector<Corner> corners_;
};

/// Disjoint sets of 0 .. n - 1.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::uint32_t{0});
  }

  std::uint32_t find(std::uint32_t a) {
    while (parents_[a] != a) a = parents_[a] = parents_[parents_[a]];
    return a;
  }
  /// The smaller root wins, so that a set is named by its smallest member.
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

/// The triangles of a mesh by component: joined across shared edges. Numbered in order of their first
/// triangle.
struct Components {
  std::vector<std::uint32_t> of_triangle;
  std::uint32_t count = 0;
};

/// Where the pulse stopped, of no use.
Components edge_components(const TriangleMesh& mesh, const EdgeTable& edges, const Pulse& pulse = {});

/// The triangles for which keep(t) holds, in order, with the vertices they use, in order.
template <class Keep>
TriangleMesh submesh(const TriangleMesh& mesh, Keep&& keep) {
  constexpr std::uint32_t unused = 0xFFFFFFFF;
  std::vector<std::uint32_t> numbers(mesh.vertices.size(), unused);
  TriangleMesh part;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (keep(t)) {
      part.triangles.push_back(mesh.triangles[t]);
      for (const std::uint32_t v : mesh.triangles[t]) numbers[v] = 0;
    }
  for (std::size_t v = 0; v < numbers.size(); ++v)
    if (numbers[v] != unused) {
      numbers[v] = static_cast<std::uint32_t>(part.vertices.size());
      part.vertices.push_back(mesh.vertices[v]);
    }
  for (Triangle& t : part.triangles) t = {numbers[t[0]], numbers[t[1]], numbers[t[2]]};
  return part;
}

}  // namespace aplomb::detail
