#pragma once

#include <array>
#include <vector>

#include "aplomb/deform/detail/tet_shape.h"
#include "aplomb/mesh/mass_properties.h"

namespace aplomb::detail {

/// What a carving that is held leaves of one tetrahedron: enough to know its moments wherever the corners go.
struct KeptShare {
  double volume_mm3 = 0;                   ///< at rest
  std::array<double, 4> at_corners_mm3{};  ///< the same, spread by barycentric weights
  Vec3 offset_mm4;                         ///< of the kept parts of cut samples from the samples' centres, times volume
};

/// Moments about `origin` of the kept solid, and their derivatives, for a carving that goes along with the cage:
///
///     V = sum_T det F_T V_T,     M = sum_T det F_T ( sum_k m_Tk (v_k - origin) + offset_T )
Moments held_moments(const TetMesh& mesh, const std::vector<TetShape>& shapes, const std::vector<KeptShare>& kept,
                     const std::vector<Vec3>& vertices, Vec3 origin);

/// The derivatives of V, M_x, M_y and M_z with respect to every vertex. By the envelope theorem these are those of the
/// best carving too: it is the best there is, so changing it changes nothing to first order.
std::array<std::vector<Vec3>, 4> moment_gradients(const TetMesh& mesh, const std::vector<TetShape>& shapes,
                                                  const std::vector<KeptShare>& kept, const std::vector<Vec3>& vertices,
                                                  Vec3 origin);

}  // namespace aplomb::detail
