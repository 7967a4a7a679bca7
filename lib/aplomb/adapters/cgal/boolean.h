#pragma once

#include <optional>

#include "aplomb/mesh/triangle_mesh.h"

/// CGAL's corefinement behind plain arrays: exact predicates, constructions rounded to double, so that what comes out
/// must be checked. These functions can throw or never end: call them through run_isolated() only.
namespace aplomb::adapters {

/// What of `body` lies outside `tool`. Triangles of either that the other does not cross stay as they are, to the bit.
/// Vertices and triangles come as in_its_own_order() has them.
/// Nothing when CGAL cannot tell.
///
/// \pre Both closed, manifold, wound outward, without self-intersection.
std::optional<TriangleMesh> difference(const TriangleMesh& body, const TriangleMesh& tool);

/// What of `body` lies inside `tool`; as difference().
std::optional<TriangleMesh> intersection(const TriangleMesh& body, const TriangleMesh& tool);

}  // namespace aplomb::adapters
