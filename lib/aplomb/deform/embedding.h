#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "aplomb/mesh/tet_mesh.h"

namespace aplomb {

/// A point that a tetrahedron carries along: sum of weights[k] * vertices[tet[k]]; the weights sum to 1.
struct EmbeddedPoint {
  std::uint32_t tet = 0;
  std::array<double, 4> weights{};

  Vec3 position(const TetMesh& mesh, const std::vector<Vec3>& vertices) const {
    const TetMesh::Tet& t = mesh.tets[tet];
    return weights[0] * vertices[t[0]] + weights[1] * vertices[t[1]] + weights[2] * vertices[t[2]] +
           weights[3] * vertices[t[3]];
  }
};

/// A piece of the solid that a tetrahedron carries along: its volume changes as the tetrahedron's does.
struct SolidSample {
  EmbeddedPoint at;
  double volume_mm3 = 0;  ///< at rest
  double carvable = 0;    ///< the share of it that may be carved, in [0, 1]
};

}  // namespace aplomb
