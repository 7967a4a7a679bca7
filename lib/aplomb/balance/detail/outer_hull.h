#pragma once

#include "aplomb/core/error.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// The convex hull of a mesh. Of more than 20000 vertices it is that of the farthest vertex in each of 13824 directions
/// from the box's centre, which may leave out corners that stand out by less than a contact height or so, and never
/// adds any. \return unusable_input for a flat mesh.
Result<TriangleMesh> outer_hull(const TriangleMesh& mesh);

}  // namespace aplomb::detail
