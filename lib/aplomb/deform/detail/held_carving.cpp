#include "aplomb/deform/detail/held_carving.h"

#include "aplomb/deform/detail/tet_energy.h"

namespace aplomb::detail {
namespace {

/// The first moment of what is kept of a tetrahedron, before the change of volume.
Vec3 first_moment(const KeptShare& kept, const TetMesh::Tet& tet, const std::vector<Vec3>& vertices, Vec3 origin) {
  Vec3 sum = kept.offset_mm4;
  for (std::size_t k = 0; k < 4; ++k) sum += kept.at_corners_mm3[k] * (vertices[tet[k]] - origin);
  return sum;
}

}  // namespace

Moments held_moments(const TetMesh& mesh, const std::vector<TetShape>& shapes, const std::vector<KeptShare>& kept,
                     const std::vector<Vec3>& vertices, Vec3 origin) {
  Moments sum;
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    if (kept[t].volume_mm3 == 0) continue;
    const double det = determinant(deformation_gradient(shapes[t], mesh.tets[t], vertices));
    sum += det * Moments{kept[t].volume_mm3, first_moment(kept[t], mesh.tets[t], vertices, origin)};
  }
  return sum;
}

std::array<std::vector<Vec3>, 4> moment_gradients(const TetMesh& mesh, const std::vector<TetShape>& shapes,
                                                  const std::vector<KeptShare>& kept, const std::vector<Vec3>& vertices,
                                                  Vec3 origin) {
  std::array<std::vector<Vec3>, 4> gradients;
  gradients.fill(std::vector<Vec3>(vertices.size()));
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    if (kept[t].volume_mm3 == 0) continue;
    const TetMesh::Tet& tet = mesh.tets[t];
    const Mat3 f = deformation_gradient(shapes[t], tet, vertices);
    const Mat3 slope = cofactor(f);
    const double det = determinant(f);
    const Vec3 first = first_moment(kept[t], tet, vertices, origin);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 of_volume = volume_slope(shapes[t], slope, k);
      const double moved = det * kept[t].at_corners_mm3[k];
      gradients[0][tet[k]] += kept[t].volume_mm3 * of_volume;
      gradients[1][tet[k]] += first.x * of_volume + Vec3{moved, 0, 0};
      gradients[2][tet[k]] += first.y * of_volume + Vec3{0, moved, 0};
      gradients[3][tet[k]] += first.z * of_volume + Vec3{0, 0, moved};
    }
  }
  return gradients;
}

}  // namespace aplomb::detail
