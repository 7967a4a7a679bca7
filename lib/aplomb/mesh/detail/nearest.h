#pragma once

#include "aplomb/mesh/detail/triangle_tree.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// The distance from p to a triangle, degenerate or not.
double distance_mm(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

/// The distance from p to the nearest triangle, or `limit_mm` when none is nearer.
double distance_mm(Vec3 p, const TriangleMesh& mesh, const TriangleTree& tree, double limit_mm);

/// The largest distance to `surface` of the vertices and triangle centres of `mesh`.
///
/// \pre Both have float32 coordinates; surface has triangles.
double largest_distance_mm(const TriangleMesh& mesh, const TriangleMesh& surface);

}  // namespace aplomb::detail
