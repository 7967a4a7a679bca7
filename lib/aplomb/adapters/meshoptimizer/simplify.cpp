#include "aplomb/adapters/meshoptimizer/simplify.h"

#include <meshoptimizer.h>

#include <limits>
#include <vector>

namespace aplomb::adapters {

TriangleMesh without_unused_vertices(const TriangleMesh& mesh) {
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), unused);
  TriangleMesh result;
  result.triangles = mesh.triangles;
  for (Triangle& t : result.triangles)
    for (std::uint32_t& v : t) {
      if (renumbered[v] == unused) {
        renumbered[v] = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[v]);
      }
      v = renumbered[v];
    }
  return result;
}

TriangleMesh simplified(const TriangleMesh& mesh, double deviation_mm) {
  const Vec3 origin = bounding_box(mesh).min;
  std::vector<float> positions;
  positions.reserve(3 * mesh.vertices.size());
  for (const Vec3& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(v[axis] - origin[axis]));
  std::vector<unsigned> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  constexpr std::size_t stride = 3 * sizeof(float);
  const float scale = meshopt_simplifyScale(positions.data(), mesh.vertices.size(), stride);
  std::vector<unsigned> kept(indices.size());
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), positions.data(), mesh.vertices.size(), stride,
                               0, static_cast<float>(deviation_mm / scale), 0, nullptr));
  TriangleMesh result{mesh.vertices, {}};
  for (std::size_t i = 0; i + 2 < kept.size(); i += 3) result.triangles.push_back({kept[i], kept[i + 1], kept[i + 2]});
  return without_unused_vertices(result);
}

}  // namespace aplomb::adapters
