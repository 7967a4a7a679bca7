#pragma once

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::adapters {

/// Collapses edges (quadric error, Garland and Heckbert 1997) while the surface moves by no more than about
/// `deviation_mm`; the vertices that stay do not move. The result may cross itself: check it.
TriangleMesh simplified(const TriangleMesh& mesh, double deviation_mm);

/// The same mesh without vertices that no triangle names.
TriangleMesh without_unused_vertices(const TriangleMesh& mesh);

}  // namespace aplomb::adapters
