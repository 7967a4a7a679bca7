#pragma once

#include <cstddef>

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// Coordinates rounded to float32, vertices at equal places made one (the first), unused ones dropped.
TriangleMesh welded(const TriangleMesh& mesh);

/// Whether both hold the same triangles, whatever their order, numbering and first corner.
bool same_triangles(const TriangleMesh& a, const TriangleMesh& b);

struct CleanSoup {
  TriangleMesh mesh;
  std::size_t merged = 0;       ///< vertices within 4 ulp of another one
  std::size_t degenerate = 0;   ///< left out: no area, or no more than rounding gives
  std::size_t duplicates = 0;   ///< left out: the same triangle again, or a wall between two bodies that has two sides
  std::size_t split_edges = 0;  ///< open edges cut where a vertex of another open edge lies on them (T-junctions)
};

/// Takes out of a triangle soup what has no say in its shape.
///
/// Two triangles on the same corners become one when they are wound alike; wound against each other both go when the
/// edges then still pair up (a wall between two bodies that meet face to face), else one stays.
///
/// \pre  mesh is welded.
/// \post No degenerate and no duplicate triangle; the surface moved by at most 4 ulp of the largest coordinate.
CleanSoup cleaned(const TriangleMesh& mesh);

}  // namespace aplomb::detail
