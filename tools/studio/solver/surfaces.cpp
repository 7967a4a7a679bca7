#include "solver/surfaces.h"

#include <map>
#include <numeric>

#include "aplomb/mesh/mass_properties.h"

namespace aplomb::studio {
namespace {

/// For each vertex, one that stands for all it is connected with.
std::vector<std::uint32_t> connected(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto find = [&parent](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : mesh.triangles)
    for (int corner = 1; corner < 3; ++corner) parent[find(t[corner])] = find(t[0]);
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = find(v);
  return parent;
}

constexpr std::uint32_t none = 0xFFFFFFFF;

/// Those triangles with the vertices that they need, which are numbered anew. No other part has any of them.
TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<std::size_t>& triangles,
                     std::vector<std::uint32_t>& number) {
  TriangleMesh part;
  for (const std::size_t t : triangles) {
    Triangle& added = part.triangles.emplace_back();
    for (int corner = 0; corner < 3; ++corner) {
      std::uint32_t& n = number[mesh.triangles[t][corner]];
      if (n == none) {
        n = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[mesh.triangles[t][corner]]);
      }
      added[corner] = n;
    }
  }
  return part;
}

}  // namespace

std::vector<Surface> surfaces_of(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> parent = connected(mesh);
  std::map<std::uint32_t, std::size_t> place;
  std::vector<std::vector<std::size_t>> parts;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [at, is_new] = place.emplace(parent[mesh.triangles[t][0]], parts.size());
    if (is_new) parts.emplace_back();
    parts[at->second].push_back(t);
  }
  std::vector<std::uint32_t> number(mesh.vertices.size(), none);
  std::vector<Surface> surfaces(1);
  for (const auto& triangles : parts) {
    TriangleMesh part = part_of(mesh, triangles, number);
    if (moments(part).volume_mm3 < 0) surfaces.push_back({std::move(part), true});
    else surfaces.front().mesh = joined(std::move(surfaces.front().mesh), part);
  }
  return surfaces;
}

}  // namespace aplomb::studio
