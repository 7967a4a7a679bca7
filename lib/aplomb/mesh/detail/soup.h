#pragma once

#include <cstddef>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// Coordinates rounded to float32, vertices at equal places made one (the first), unused ones dropped.
/// \return cancelled.
Result<TriangleMesh> welded(const TriangleMesh& mesh, const Job& job);
inline TriangleMesh welded(const TriangleMesh& mesh) { return *welded(mesh, {}); }

/// Whether both hold the same triangles, whatever their order, numbering and first corner.
bool same_triangles(const TriangleMesh& a, const TriangleMesh& b);

/// The triangles of `mesh` that `old` has nowhere.
TriangleMesh new_triangles(const TriangleMesh& mesh, const TriangleMesh& old);

struct CleanSoup {
  TriangleMesh mesh;
  std::size_t merged = 0;       ///< vertices within 4 ulp of another one
  std::size_t degenerate = 0;   ///< left out: no area, or no more than rounding gives
  std::size_t duplicates = 0;   ///< left out: the same triangle again, or a wall between two bodies that has two sides
  std::size_t split_edges = 0;  ///< open edges cut where a vertex of another open edge lies on them (T-junctions)
};

/// Takes out of a triangle soup what has no say in its shape.
///
/// Triangles on the same corners become one. But a patch of two-sided triangles that is a wall between two bodies goes:
/// where the surfaces at its rim pair up without it.
///
/// \pre  mesh is welded.
/// \post No degenerate and no duplicate triangle; the surface moved by at most 4 ulp of the largest coordinate.
CleanSoup cleaned(const TriangleMesh& mesh);

}  // namespace aplomb::detail
