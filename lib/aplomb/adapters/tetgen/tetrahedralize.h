#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/isolated.h"
#include "aplomb/core/job.h"
#include "aplomb/core/vec.h"
#include "aplomb/mesh/tet_mesh.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::adapters {

struct TetrahedraSize {
  double most_mm3 = 0;             ///< of a tetrahedron; 0: no limit
  double radius_edge_ratio = 1.5;  ///< circumradius by shortest edge, at most; > 1.2
};

/// Fills what a closed surface bounds with tetrahedra, by TetGen 1.5 (Si 2015) in a child process. The surface keeps
/// its shape and may get more vertices.
///
/// \param void_points_mm  one inside each void.
/// \pre  The surface bounds a solid: TetGen crashes on one that crosses itself.
/// \post Positively oriented tetrahedra, none without volume.
/// \return as run_isolated(): third_party when TetGen dies or gives nothing that can be used.
Result<TetMesh> tetrahedralize(const TriangleMesh& surface, const std::vector<Vec3>& void_points_mm,
                               const TetrahedraSize& size, const IsolationLimits& limits, const Job& job = {});

}  // namespace aplomb::adapters
