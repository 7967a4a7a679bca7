#include "aplomb/mesh/marching_tetrahedra.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <vector>

namespace aplomb {
namespace {

constexpr std::uint32_t unset = std::numeric_limits<std::uint32_t>::max();

/// An edge of Kuhn's split runs from a lattice corner to one with more bits set: 19 of them in a cell.
struct Edge {
  std::uint8_t low = 0, high = 0;  // corners; low is a subset of high's bits
};

/// Kuhn's six tetrahedra by their cell corners, positively oriented: 0, one axis, two axes, 7.
constexpr std::array<std::array<std::uint8_t, 4>, 6> tets{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}}};

struct TriangleCase {
  int triangles = 0;                    // 0, 1 or 2
  std::array<std::uint8_t, 6> edges{};  // indices into CellEdges
};

struct Tables {
  std::array<Edge, 19> edges{};
  std::array<std::array<TriangleCase, 16>, 6> cases{};  // by tetrahedron, by the mask of its inside corners
};

constexpr std::uint8_t edge_index(const Tables& tables, std::uint8_t a, std::uint8_t b) {
  for (std::size_t e = 0; e < tables.edges.size(); ++e)
    if ((tables.edges[e].low == a && tables.edges[e].high == b) ||
        (tables.edges[e].low == b && tables.edges[e].high == a))
      return static_cast<std::uint8_t>(e);
  return 255;
}

constexpr bool is_even(std::array<int, 4> permutation) {
  int inversions = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) inversions += permutation[i] > permutation[j];
  return inversions % 2 == 0;
}

/// The triangles between the inside and outside corners of one positively oriented tetrahedron.
constexpr TriangleCase triangle_case(const Tables& tables, std::array<std::uint8_t, 4> tet, unsigned mask) {
  std::array<int, 4> order{};  // inside corners first, an even permutation
  int count = 0;
  for (int i = 0; i < 4; ++i)
    if (mask >> i & 1) order[count++] = i;
  const int inside = count;
  for (int i = 0; i < 4; ++i)
    if (!(mask >> i & 1)) order[count++] = i;
  if (inside == 0 || inside == 4) return {};
  if (!is_even(order)) {
    const int first = inside == 3 ? 0 : 2;  // swap two of the same side
    const int swapped = order[first];
    order[first] = order[first + 1];
    order[first + 1] = swapped;
  }
  const auto edge = [&](int i, int j) { return edge_index(tables, tet[order[i]], tet[order[j]]); };
  if (inside == 1) return {1, {edge(0, 1), edge(0, 2), edge(0, 3)}};
  if (inside == 3) return {1, {edge(3, 0), edge(3, 1), edge(3, 2)}};
  const std::uint8_t ac = edge(0, 2), ad = edge(0, 3), bd = edge(1, 3), bc = edge(1, 2);
  return {2, {ac, ad, bd, ac, bd, bc}};
}

constexpr Tables make_tables() {
  Tables tables;
  std::size_t count = 0;
  for (std::uint8_t low = 0; low < 8; ++low)
    for (std::uint8_t high = 0; high < 8; ++high)
      if (low != high && (low & high) == low) tables.edges[count++] = {low, high};
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (unsigned mask = 0; mask < 16; ++mask) tables.cases[t][mask] = triangle_case(tables, tets[t], mask);
  return tables;
}

constexpr Tables tables = make_tables();

/// Vertex numbers by lattice edge: open addressing, doubled at half full.
class EdgeVertices {
 public:
  explicit EdgeVertices(std::size_t expected) { rehash(std::bit_ceil(2 * expected + 16)); }

  /// The slot of a key, `unset` when new. Valid until the next call.
  std::uint32_t& operator[](std::uint64_t key) {
    if (2 * used_ >= slots_.size()) rehash(2 * slots_.size());
    Slot& slot = find(key);
    if (slot.vertex == unset) {
      slot.key = key;
      ++used_;
    }
    return slot.vertex;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t vertex = unset;
  };

  Slot& find(std::uint64_t key) {
    std::size_t at = (key * 0x9E3779B97F4A7C15ULL) >> shift_;
    while (slots_[at].vertex != unset && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
    return slots_[at];
  }

  void rehash(std::size_t size) {
    std::vector<Slot> old(size);
    old.swap(slots_);
    shift_ = 64 - std::countr_zero(size);
    for (const Slot& slot : old)
      if (slot.vertex != unset) find(slot.key) = slot;
  }

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  int shift_ = 64;
};

class Mesher {
 public:
  Mesher(std::span<const CornerCell> cells, double voxel_mm, Vec3 origin_mm)
      : voxel_mm_(voxel_mm), origin_mm_(origin_mm), vertices_(5 * cells.size()) {
    for (const CornerCell& cell : cells)
      for (std::size_t axis = 0; axis < 3; ++axis) low_[axis] = std::min(low_[axis], cell.ijk[axis]);
    mesh_.vertices.reserve(5 * cells.size());
    mesh_.triangles.reserve(9 * cells.size());
  }

  void add(const CornerCell& cell) {
    unsigned inside = 0;
    for (unsigned c = 0; c < 8; ++c) inside |= static_cast<unsigned>(cell.values[c] < 0) << c;
    if (inside == 0 || inside == 255) return;
    std::array<std::uint32_t, 19> on_edge{};
    for (std::size_t e = 0; e < tables.edges.size(); ++e) {
      const Edge edge = tables.edges[e];
      if ((inside >> edge.low & 1) != (inside >> edge.high & 1)) on_edge[e] = vertex(cell, edge);
    }
    for (std::size_t t = 0; t < tets.size(); ++t) {
      unsigned mask = 0;
      for (unsigned i = 0; i < 4; ++i) mask |= (inside >> tets[t][i] & 1U) << i;
      const TriangleCase& triangles = tables.cases[t][mask];
      for (std::size_t k = 0; k < 3 * static_cast<std::size_t>(triangles.triangles); k += 3)
        mesh_.triangles.push_back(
            {on_edge[triangles.edges[k]], on_edge[triangles.edges[k + 1]], on_edge[triangles.edges[k + 2]]});
    }
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertex(const CornerCell& cell, Edge edge) {
    std::uint64_t key = 0;
    Vec3 at;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::int64_t lattice = std::int64_t{cell.ijk[axis]} + (edge.low >> axis & 1);
      key = key << 20 | static_cast<std::uint64_t>(lattice - low_[axis]);
      at[static_cast<int>(axis)] = static_cast<double>(lattice);
    }
    const unsigned along = edge.high ^ edge.low;
    std::uint32_t& number = vertices_[key << 3 | along];
    if (number != unset) return number;
    number = static_cast<std::uint32_t>(mesh_.vertices.size());
    const double low = cell.values[edge.low], high = cell.values[edge.high];
    const double share = low / (low - high);
    for (unsigned axis = 0; axis < 3; ++axis)
      if (along >> axis & 1) at[static_cast<int>(axis)] += share;
    mesh_.vertices.push_back(origin_mm_ + voxel_mm_ * at);
    return number;
  }

  double voxel_mm_;
  Vec3 origin_mm_;
  std::array<std::int32_t, 3> low_{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max(),
                                   std::numeric_limits<std::int32_t>::max()};
  EdgeVertices vertices_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh marching_tetrahedra(std::span<const CornerCell> cells, double voxel_mm, Vec3 origin_mm,
                                 const Pulse& pulse) {
  assert(voxel_mm > 0);
  Mesher mesher(cells, voxel_mm, origin_mm);
  for (const CornerCell& cell : cells) {
    if (!pulse.goes_on()) break;
    mesher.add(cell);
  }
  return mesher.take();
}

}  // namespace aplomb
