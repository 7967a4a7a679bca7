#include "aplomb/adapters/meshoptimizer/simplify.h"

#include <meshoptimizer.h>

namespace aplomb::adapters {

std::vector<Triangle> simplified(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                 double deviation_mm) {
  Box3 box;
  for (const Vec3& v : vertices) box.add(v);
  std::vector<float> positions;
  positions.reserve(3 * vertices.size());
  for (const Vec3& v : vertices)
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(v[axis] - box.min[axis]));
  std::vector<unsigned> indices;
  indices.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) indices.insert(indices.end(), t.begin(), t.end());
  constexpr std::size_t stride = 3 * sizeof(float);
  const double extent = meshopt_simplifyScale(positions.data(), vertices.size(), stride);
  std::vector<unsigned> kept(indices.size());
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), positions.data(), vertices.size(), stride,
                               0, static_cast<float>(deviation_mm / extent), meshopt_SimplifyLockBorder, nullptr));
  std::vector<Triangle> result;
  for (std::size_t i = 0; i + 2 < kept.size(); i += 3) result.push_back({kept[i], kept[i + 1], kept[i + 2]});
  return result;
}

}  // namespace aplomb::adapters
