#include "aplomb/printability/printed_solid.h"

#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/topology.h"

namespace aplomb {

PrintedSolid printed_solid(const SolidMesh& solid) {
  const TriangleMesh& mesh = solid.mesh();
  const detail::Components components = detail::edge_components(mesh, detail::EdgeTable(mesh));
  const std::vector<double> volumes = detail::volumes_mm3(mesh, components);
  const auto shell_of = [&](std::size_t t) { return components.of_triangle[t]; };
  PrintedSolid printed{solid, detail::submesh(mesh, [&](std::size_t t) { return volumes[shell_of(t)] > 0; }), {}};
  for (std::uint32_t shell = 0; shell < components.count; ++shell)
    if (volumes[shell] < 0)
      printed.voids.push_back(detail::submesh(mesh, [&](std::size_t t) { return shell_of(t) == shell; }));
  return printed;
}

}  // namespace aplomb
