#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::adapters {

/// Triangulates what closed loops of edges enclose (by the even-odd rule) without adding a point: a constrained
/// Delaunay triangulation. Triangles run counter-clockwise and index `points_mm`.
///
/// \pre  Every point has an even number of edges; points are distinct.
/// \return third_party when edges cross or a point lies on an edge.
Result<std::vector<Triangle>> fill_polygon(std::span<const Vec2> points_mm,
                                           std::span<const std::array<std::uint32_t, 2>> edges);

}  // namespace aplomb::adapters
