#include "aplomb/mesh/detail/shells.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/nesting.h"
#include "aplomb/mesh/mass_properties.h"

namespace aplomb::detail {
namespace {

struct Shells {
  Components components;
  std::vector<double> volumes;
  std::vector<std::vector<Enclosure>> enclosing;
  std::vector<bool> crosses;  // another component
};

Result<Shells> shells_of(const TriangleMesh& mesh, const Job& job) {
  const EdgeTable edges(mesh);
  Shells shells{edge_components(mesh, edges), {}, {}, {}};
  shells.volumes = volumes_mm3(mesh, shells.components);
  Nesting nesting(mesh, edges, shells.components);
  auto enclosing = nesting.enclosures(job.part(0, 0.5));
  if (!enclosing) return tl::unexpected(enclosing.error());
  shells.enclosing = std::move(*enclosing);
  auto touching = nesting.touching(job.part(0.5, 1));
  if (!touching) return tl::unexpected(touching.error());
  shells.crosses.resize(shells.components.count);
  for (std::uint32_t c = 0; c < shells.components.count; ++c)
    if (const std::uint32_t first = touching->find(c); first != c) shells.crosses[first] = shells.crosses[c] = true;
  return shells;
}

/// Which shells to turn: those that nothing encloses and that are inside out, and with each all that it encloses.
std::vector<bool> turns_of(const Shells& shells) {
  const std::uint32_t count = shells.components.count;
  std::vector<bool> turns(count);
  for (std::uint32_t c = 0; c < count; ++c)
    if (shells.enclosing[c].empty() && shells.volumes[c] < 0) turns[c] = true;
  for (std::uint32_t c = 0; c < count; ++c)
    if (!shells.crosses[c])
      for (const Enclosure& e : shells.enclosing[c])
        if (shells.enclosing[e.component].empty() && turns[e.component]) turns[c] = true;
  return turns;
}

}  // namespace

Result<OrientedShells> oriented_shells(const TriangleMesh& mesh, const Job& job) {
  if (mesh.triangles.empty()) return OrientedShells{mesh};
  const Result<Shells> found = shells_of(mesh, job);
  if (!found) return tl::unexpected(found.error());
  const Shells& shells = *found;
  const std::vector<bool> turns = turns_of(shells);
  std::vector<std::uint32_t> outermost_first(shells.components.count);
  std::iota(outermost_first.begin(), outermost_first.end(), 0U);
  std::stable_sort(outermost_first.begin(), outermost_first.end(), [&](std::uint32_t a, std::uint32_t b) {
    return shells.enclosing[a].size() < shells.enclosing[b].size();
  });

  OrientedShells result;
  std::vector<bool> dropped(shells.components.count);
  for (const std::uint32_t c : outermost_first) {
    int winding = 0;
    for (const Enclosure& e : shells.enclosing[c])
      if (!dropped[e.component]) winding += turns[e.component] ? -e.winding : e.winding;
    const bool is_void = (shells.volumes[c] < 0) != turns[c];
    dropped[c] = !shells.crosses[c] && winding != (is_void ? 1 : 0);
    result.dropped += dropped[c];
    result.turned += turns[c] && !dropped[c];
  }
  const auto component = [&](std::uint32_t t) { return shells.components.of_triangle[t]; };
  TriangleMesh wound = mesh;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (turns[component(t)]) std::swap(wound.triangles[t][1], wound.triangles[t][2]);
  result.mesh = submesh(wound, [&](std::uint32_t t) { return !dropped[component(t)]; });
  return result;
}

std::vector<TriangleMesh> bodies_to_unite(const TriangleMesh& mesh) {
  const Components components = edge_components(mesh, EdgeTable(mesh));
  constexpr std::uint32_t most_bodies = 64;
  if (components.count < 2 || components.count > most_bodies) return {};
  for (const double volume : volumes_mm3(mesh, components))
    if (volume <= 0) return {};
  std::vector<TriangleMesh> bodies;
  for (std::uint32_t c = 0; c < components.count; ++c)
    bodies.push_back(submesh(mesh, [&](std::uint32_t t) { return components.of_triangle[t] == c; }));
  return bodies;
}

std::size_t count_bodies(const TriangleMesh& mesh) {
  const auto volumes = volumes_mm3(mesh, edge_components(mesh, EdgeTable(mesh)));
  return static_cast<std::size_t>(std::count_if(volumes.begin(), volumes.end(), [](double v) { return v > 0; }));
}

TriangleMesh without_crumbs(const TriangleMesh& mesh) {
  const Components components = edge_components(mesh, EdgeTable(mesh));
  const std::vector<double> volumes = volumes_mm3(mesh, components);
  const double least = 1e-3 * moments(mesh).volume_mm3;
  return submesh(mesh, [&](std::uint32_t t) { return std::abs(volumes[components.of_triangle[t]]) >= least; });
}

}  // namespace aplomb::detail
