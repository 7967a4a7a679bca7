#pragma once

#include <vector>

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::studio {

/// A closed surface of a shell.
struct Surface {
  TriangleMesh mesh;
  bool is_void = false;  ///< it is wound inward
};

/// The surfaces of a closed mesh: the outside first, then its voids, each in the order of the mesh. What lies outside
/// is one, of several bodies, too.
std::vector<Surface> surfaces_of(const TriangleMesh& mesh);

}  // namespace aplomb::studio
