#pragma once

#include <span>

#include "aplomb/core/error.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::adapters {

/// The convex hull as a closed mesh of triangles wound outward (CGAL's quickhull, exact predicates).
/// \post The same whatever the order of the points, but for how corners in one plane are split into triangles.
/// \return unusable_input when all points lie in one plane.
/// \par Cost  O(n log n).
Result<TriangleMesh> convex_hull(std::span<const Vec3> points_mm);

}  // namespace aplomb::adapters
