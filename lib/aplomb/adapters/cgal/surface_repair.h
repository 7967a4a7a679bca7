#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "aplomb/mesh/triangle_mesh.h"

/// CGAL's mesh repair behind plain arrays. These functions can throw, abort, write to stderr, crash or never end on
/// the meshes they are given: call them through run_isolated() only.
namespace aplomb::adapters {

/// A hole that was filled.
struct FilledHole {
  std::size_t edges = 0;
  double diameter_mm = 0;  ///< the diagonal of its rim's box
  double area_mm2 = 0;     ///< of the triangles put in
};

struct ClosedSurface {
  TriangleMesh mesh;  ///< the given triangles, some re-wound, followed by the patches
  std::vector<FilledHole> holes;
  std::size_t holes_left = 0;  ///< rims for which no patch was found
};

/// Winds neighbouring triangles alike, cuts the surface apart where it is no manifold, sews what can be sewn and fills
/// every hole with the triangulation of its rim of least area.
///
/// \pre No degenerate and no duplicate triangle.
ClosedSurface closed_surface(const TriangleMesh& soup);

/// The union of closed bodies; surfaces away from the crossings stay as they are. Nothing when CGAL cannot tell.
///
/// \pre Each body is closed, manifold, wound outward and does not cross itself.
std::optional<TriangleMesh> united(const std::vector<TriangleMesh>& bodies);

/// The surface with the regions round its self-intersections cut out and filled again, at most seven times.
///
/// \pre Closed, manifold, consistently wound.
std::optional<TriangleMesh> without_self_intersections(const TriangleMesh& mesh);

}  // namespace aplomb::adapters
