#pragma once

#include <vector>

#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {

/// A solid as it stands on the plate to be printed (up is +z, its lowest point on the plate), taken apart.
struct PrintedSolid {
  SolidMesh solid;
  TriangleMesh outer;               ///< every outer shell
  std::vector<TriangleMesh> voids;  ///< one closed surface each, wound inward as in the solid
};

/// \par Cost  O(n voids).
PrintedSolid printed_solid(const SolidMesh& solid);

}  // namespace aplomb
