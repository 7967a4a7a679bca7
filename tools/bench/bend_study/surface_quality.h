#pragma once

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::bench {

/// How a bend shows on a surface.
struct SurfaceQuality {
  /// Change of the dihedral angle over an edge, of all edges; the mean square by the area of the smaller facet beside,
  /// so that slivers, which turn over at a touch and which nobody sees, weigh next to nothing.
  double crease_rms_deg = 0, crease_p99_deg = 0, crease_max_deg = 0;
  /// How unevenly the surface turns: of each facet the distance between its rotation vector (of the polar
  /// decomposition of the facet's map, normal onto normal) and the mean of its three neighbours'. A rigid motion has
  /// none, a smooth bend next to none. The mean is by area.
  double unevenness_mean_deg = 0, unevenness_p99_deg = 0;
  double mean_from_mm = 0;  ///< of the vertices, from a third surface
};

/// \pre The meshes have the same triangles; rest is closed and 2-manifold.
SurfaceQuality measure_quality(const TriangleMesh& rest, const TriangleMesh& moved, const TriangleMesh& reference);

}  // namespace aplomb::bench
