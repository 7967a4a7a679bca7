#include "aplomb/adapters/cgal/mesh_order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

namespace aplomb::adapters {

TriangleMesh in_its_own_order(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.vertices.size()), rank(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) {
    return std::tie(mesh.vertices[i].x, mesh.vertices[i].y, mesh.vertices[i].z);
  };
  std::ranges::stable_sort(order, {}, place);
  TriangleMesh ordered;
  for (const std::uint32_t i : order) {
    rank[i] = static_cast<std::uint32_t>(ordered.vertices.size());
    ordered.vertices.push_back(mesh.vertices[i]);
  }
  for (Triangle t : mesh.triangles) {
    for (std::uint32_t& corner : t) corner = rank[corner];
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    ordered.triangles.push_back(t);
  }
  std::ranges::sort(ordered.triangles);
  return ordered;
}

}  // namespace aplomb::adapters
