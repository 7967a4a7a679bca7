#pragma once

#include <vector>

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::adapters {

/// Collapses edges (quadric error, Garland and Heckbert 1997) of some triangles of a mesh while the surface moves by no
/// more than about `deviation_mm`; vertices do not move, and those on the triangles' rim stay. The result may be
/// non-manifold in places and cross itself: check it.
std::vector<Triangle> simplified(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                 double deviation_mm);

}  // namespace aplomb::adapters
