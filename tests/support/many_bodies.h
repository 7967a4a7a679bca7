#pragma once

#include "aplomb/mesh/triangle_mesh.h"

/// Files of very many small bodies: tetrahedra of four triangles each.
namespace aplomb::test {

TriangleMesh tetrahedra_apart(int count);
/// In a column, one above the other.
TriangleMesh tetrahedra_stacked(int count);
/// The first is the innermost, wound outward like all; or the first is the outermost.
TriangleMesh tetrahedra_nested(int count, bool innermost_first = true);
/// Every one crosses every other.
TriangleMesh tetrahedra_crossing(int count);
/// Needles beside one another, slanted so that their boxes overlap though they do not touch.
TriangleMesh needles_slanted(int count);

}  // namespace aplomb::test
