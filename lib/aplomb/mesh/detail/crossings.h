#pragma once

#include <cstddef>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/detail/triangle_tree.h"

namespace aplomb::detail {

/// Counting stops after this many: a mesh with more is as broken as can be.
constexpr std::size_t most_crossings = 1'000'000;

/// The number of pairs of triangles that cross, overlap or touch anywhere but in the vertices and edges they
/// share; exact. Triangles marked `skipped` and pairs with the same three vertices do not count.
///
/// \pre  Coordinates are float32 values; `skipped` has an entry per triangle, true for every degenerate one.
/// \return cancelled; unusable_input where 100 pairs of boxes a triangle and 30 million more would not do (models have
///         6 to 41 a triangle).
/// \par Cost  0.15 s of CPU for 100k triangles; on all threads.
Result<std::size_t> count_crossings(const TriangleMesh& mesh, const TriangleTree& tree,
                                    const std::vector<bool>& skipped, const Job& job);

/// Marks the triangles that count_crossings() would count, with the same promises.
Result<std::vector<bool>> crossing_triangles(const TriangleMesh& mesh, const TriangleTree& tree,
                                             const std::vector<bool>& skipped, const Job& job);

/// Whether two triangles meet anywhere but in the vertices and edges they share; exact.
///
/// \pre Neither is degenerate.
bool cross(const TriangleMesh& mesh, const Triangle& s, const Triangle& t);

/// +1 or -1 when the upward ray from p leaves or enters through the triangle, p moved by (-eps^2, eps, 0) so that it
/// meets no edge; else 0. Exact.
int crossing_above(const TriangleMesh& mesh, const Triangle& t, Vec3 p);

/// The volume each component encloses, negative when it is wound inward.
std::vector<double> volumes_mm3(const TriangleMesh& mesh, const Components& components);

/// Of all triangles.
double surface_area_mm2(const TriangleMesh& mesh);

}  // namespace aplomb::detail
