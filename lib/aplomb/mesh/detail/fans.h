#pragma once

#include <cstddef>

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// The same triangles with a vertex of its own for every fan, so that parts which only touch in a vertex or an edge are
/// apart. At an edge of more than two triangles, those stay together that bound the same wedge of the solid; where
/// their windings tell of no wedges, all are parted.
TriangleMesh cut_apart(const TriangleMesh& mesh);

/// Fans at the same place drawn back from one another, each against its normal by 64 ulp of the largest coordinate.
struct SetApart {
  TriangleMesh mesh;
  std::size_t places = 0;
  double distance_mm = 0;
};
SetApart set_apart(const TriangleMesh& cut);

}  // namespace aplomb::detail
