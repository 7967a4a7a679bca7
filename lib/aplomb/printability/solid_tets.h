#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/solid_mesh.h"
#include "aplomb/mesh/tet_mesh.h"

namespace aplomb {

struct TetCounts {
  std::size_t few = 4'000;    ///< none has more than the volume of the solid divided by this
  std::size_t most = 80'000;  ///< a coarser surface is tried, then it is refused
};

struct SolidTets {
  TetMesh mesh;
  double deviation_mm = 0;  ///< how far a vertex of the solid may be from their surface
};

/// A solid as tetrahedra for elasticity. Its surface is simplified first, by 0.02 % of the box's diagonal and up to
/// 0.32 % where that leaves too many triangles or tetrahedra.
///
/// \return over_budget for more than counts.most tetrahedra; third_party when TetGen dies; cancelled.
/// \par Cost  lib/README.md, "Strength by elasticity".
Result<SolidTets> solid_tets(const SolidMesh& solid, const TetCounts& counts = {}, const Job& job = {});

/// The surface of tetrahedra, wound outward, and the vertex of the tetrahedra that each of its vertices is.
struct TetSurface {
  TriangleMesh mesh;
  std::vector<std::uint32_t> tet_vertices;
};
TetSurface surface_of(const TetMesh& mesh);

}  // namespace aplomb
