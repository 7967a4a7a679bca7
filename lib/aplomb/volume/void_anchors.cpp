#include "aplomb/volume/void_anchors.h"

#include <algorithm>
#include <limits>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/mesh/detail/topology.h"

namespace aplomb {
namespace {

bool holds(const Box3& box, const Box3& other) {
  for (int axis = 0; axis < 3; ++axis)
    if (other.min[axis] < box.min[axis] || other.max[axis] > box.max[axis]) return false;
  return true;
}

VoidAnchor shortest_line(const TriangleMesh& hole, const TriangleMesh& outside) {
  const adapters::SurfaceDistance surface(outside);
  VoidAnchor anchor;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& from : hole.vertices) {
    const auto nearest = surface.closest(from);
    if (nearest.distance_mm >= least) continue;
    least = nearest.distance_mm;
    anchor = {from, surface.closest_point(from, nearest.triangle)};
  }
  return anchor;
}

}  // namespace

double VoidAnchor::distance_mm(Vec3 point_mm) const {
  const Vec3 along = to_mm - from_mm;
  const double share = std::clamp(dot(point_mm - from_mm, along) / squared_norm(along), 0.0, 1.0);
  return norm(point_mm - (from_mm + share * along));
}

std::vector<VoidAnchor> void_anchors(const SolidMesh& solid) {
  if (solid.voids() == 0) return {};
  const TriangleMesh& mesh = solid.mesh();
  const auto components = detail::edge_components(mesh, detail::EdgeTable(mesh));
  std::vector<TriangleMesh> shells;
  for (std::uint32_t n = 0; n < components.count; ++n)
    shells.push_back(detail::submesh(mesh, [&](std::uint32_t t) { return components.of_triangle[t] == n; }));
  std::vector<VoidAnchor> anchors;
  for (const TriangleMesh& hole : shells) {
    if (moments(hole).volume_mm3 > 0) continue;
    TriangleMesh outside;  // of the body round it: not of one that lies in the void
    for (const TriangleMesh& shell : shells)
      if (moments(shell).volume_mm3 > 0 && holds(bounding_box(shell), bounding_box(hole)))
        outside = joined(std::move(outside), shell);
    anchors.push_back(shortest_line(hole, outside));
  }
  return anchors;
}

}  // namespace aplomb
