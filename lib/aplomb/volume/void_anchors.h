#pragma once

#include <vector>

#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {

/// A straight line from a void that a solid already has to the outside of its body.
struct VoidAnchor {
  Vec3 from_mm, to_mm;

  double distance_mm(Vec3 point_mm) const;
};

/// One for every void of the solid, from one of its vertices to the nearest point outside. What carving leaves round
/// them keeps the walls of these voids from coming loose inside a new one.
///
/// \par Cost  a distance (2 us) per vertex of the voids.
std::vector<VoidAnchor> void_anchors(const SolidMesh& solid);

}  // namespace aplomb
