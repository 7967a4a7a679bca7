#pragma once

#include <array>
#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/mesh/tet_mesh.h"

namespace aplomb::detail {

/// A tetrahedron at rest: how its deformation gradient follows from its corners, F = sum_k v_k (outer) slopes[k].
struct TetShape {
  double volume_mm3 = 0;
  std::array<Vec3, 4> slopes;  ///< gradients of the barycentric coordinates, per mm; they sum to zero
};

/// \pre Every tetrahedron is positively oriented.
std::vector<TetShape> tet_shapes(const TetMesh& rest);

/// F of a tetrahedron for these vertices.
Mat3 deformation_gradient(const TetShape& shape, const TetMesh::Tet& tet, const std::vector<Vec3>& vertices);

/// The derivative of det F with respect to the k-th corner, where `cofactor` is that of F.
constexpr Vec3 volume_slope(const TetShape& shape, const Mat3& cofactor, std::size_t k) {
  return cofactor * shape.slopes[k];
}

}  // namespace aplomb::detail
