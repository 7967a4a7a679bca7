#include "aplomb/deform/detail/tet_shape.h"

#include <cassert>

namespace aplomb::detail {

std::vector<TetShape> tet_shapes(const TetMesh& rest) {
  std::vector<TetShape> shapes;
  shapes.reserve(rest.tets.size());
  for (const TetMesh::Tet& tet : rest.tets) {
    const Vec3 a = rest.vertices[tet[1]] - rest.vertices[tet[0]];
    const Vec3 b = rest.vertices[tet[2]] - rest.vertices[tet[0]];
    const Vec3 c = rest.vertices[tet[3]] - rest.vertices[tet[0]];
    const double volume6 = dot(a, cross(b, c));
    assert(volume6 > 0);
    TetShape shape;
    shape.volume_mm3 = volume6 / 6;
    shape.slopes[1] = cross(b, c) / volume6;
    shape.slopes[2] = cross(c, a) / volume6;
    shape.slopes[3] = cross(a, b) / volume6;
    shape.slopes[0] = -(shape.slopes[1] + shape.slopes[2] + shape.slopes[3]);
    shapes.push_back(shape);
  }
  return shapes;
}

Mat3 deformation_gradient(const TetShape& shape, const TetMesh::Tet& tet, const std::vector<Vec3>& vertices) {
  Mat3 f{{{{}, {}, {}}}};
  for (std::size_t k = 1; k < 4; ++k) {
    const Vec3 edge = vertices[tet[k]] - vertices[tet[0]];
    f.rows[0] += edge.x * shape.slopes[k];
    f.rows[1] += edge.y * shape.slopes[k];
    f.rows[2] += edge.z * shape.slopes[k];
  }
  return f;
}

}  // namespace aplomb::detail
