#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "aplomb/core/pulse.h"
#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// A cube of a sampled scalar field: eight values at the corners of the grid cell whose lowest corner is
/// `ijk`.
struct CornerCell {
  std::array<std::int32_t, 3> ijk{};
  std::array<float, 8> values{};  ///< corner c stands at ijk + (c & 1, c >> 1 & 1, c >> 2 & 1); negative is inside
};

/// Meshes the zero of a sampled field: six tetrahedra round the main diagonal of every cell (Kuhn's split,
/// the same in every cell, so that neighbours match), the zero interpolated linearly along their edges,
/// normals towards the positive side. Corner c of a cell stands at origin_mm + voxel_mm * (ijk + c).
///
/// \pre  No value is zero or NaN; cells that share a corner agree on its value; no cell is listed twice; the
/// cells
///       span less than 2^20 - 1 cells along each axis.
/// \post When every sign-changing cell of a field that is positive on its rim is listed: closed and
/// 2-manifold, every
///       vertex strictly inside its edge. The order of vertices and triangles follows the order of the cells
///       alone.
///       Where the pulse stopped, open.
/// \par Cost  O(cells); 30 ms for 250k triangles.
TriangleMesh marching_tetrahedra(std::span<const CornerCell> cells, double voxel_mm, Vec3 origin_mm,
                                 const Pulse& pulse = {});

}  // namespace aplomb
