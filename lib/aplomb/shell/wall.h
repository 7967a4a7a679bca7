#pragma once

#include <cstdint>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

struct WallMeasure {
  double least_mm = 0;              ///< infinity when one of the surfaces is empty
  std::vector<std::uint32_t> thin;  ///< triangles of the inner surface that are nearer than was required
};

/// The least distance between two surfaces, never more than the true one and less by at most 1e-4 of it.
/// Works on triangles, not on samples: on a triangle with corners at distances d_i and an enclosing circle of
/// radius R, d(x)^2 >= min d_i^2 - R^2, for d^2 - |x|^2 is concave. Where that is not enough, triangles with R above
/// the wall are split, and the others are measured against every outer triangle near them.
///
/// \pre No triangle is degenerate; coordinates are float32 values. Surfaces that meet are 0 apart.
/// \return cancelled.
/// \par Cost  one distance per vertex of `inner`, and about one more per triangle; shared by the threads allowed.
Result<WallMeasure> measure_wall(const TriangleMesh& inner, const TriangleMesh& outer, double required_mm,
                                 const Job& job = {});

}  // namespace aplomb
