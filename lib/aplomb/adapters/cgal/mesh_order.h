#pragma once

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::adapters {

/// The same mesh with vertices by their coordinates and triangles by their vertices, each from its smallest one on.
/// CGAL's order follows the addresses of its nodes, which nobody chose; this one is the same in every run.
/// Only vertices that share a place keep the order in which they were given.
TriangleMesh in_its_own_order(const TriangleMesh& mesh);

}  // namespace aplomb::adapters
