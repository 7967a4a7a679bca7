#include "aplomb/balance/detail/outer_hull.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "aplomb/adapters/cgal/convex_hull.h"

namespace aplomb::detail {
namespace {

/// The farthest vertex in each cell of a cube drawn around the centre: a hull's worth of points, however fine the mesh.
std::vector<Vec3> outer_vertices(const TriangleMesh& mesh) {
  constexpr std::size_t enough = 20000;
  constexpr std::size_t cells = 48;  // along an edge of the cube
  if (mesh.vertices.size() <= enough) return mesh.vertices;
  const Box3 box = bounding_box(mesh);
  const Vec3 center = 0.5 * (box.min + box.max);
  std::vector<Vec3> farthest(6 * cells * cells);  // from the centre
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 out = vertex - center;
    int axis = 0;
    for (const int other : {1, 2})
      if (std::abs(out[other]) > std::abs(out[axis])) axis = other;
    const double reach = std::abs(out[axis]);
    if (reach == 0) continue;
    const auto cell = [&](double along) {
      return std::min(static_cast<std::size_t>((along / reach + 1) / 2 * double{cells}), cells - 1);
    };
    const std::size_t face = 2 * static_cast<std::size_t>(axis) + (out[axis] > 0 ? 1 : 0);
    Vec3& known = farthest[(face * cells + cell(out[(axis + 1) % 3])) * cells + cell(out[(axis + 2) % 3])];
    if (squared_norm(out) > squared_norm(known)) known = out;
  }
  std::erase(farthest, Vec3{});
  for (Vec3& point : farthest) point += center;
  return farthest;
}

}  // namespace

Result<TriangleMesh> outer_hull(const TriangleMesh& mesh) { return adapters::convex_hull(outer_vertices(mesh)); }

}  // namespace aplomb::detail
