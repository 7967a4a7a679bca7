#include "aplomb/deform/surface_motion.h"

#include <fmt/format.h>

#include <cassert>

namespace aplomb {
namespace {

/// Columns b - a, c - a, d - a.
Mat3 edges_of(const TetMesh::Tet& t, const std::vector<Vec3>& vertices) {
  const Vec3 a = vertices[t[0]];
  return transposed(Mat3{{{vertices[t[1]] - a, vertices[t[2]] - a, vertices[t[3]] - a}}});
}

Mat3 inverse(const Mat3& m) {
  const Vec3 &a = m.rows[0], &b = m.rows[1], &c = m.rows[2];
  const double d = determinant(m);
  return transposed(Mat3{{{cross(b, c) / d, cross(c, a) / d, cross(a, b) / d}}});
}

/// The mean deformation gradient at every vertex; the identity at those that stayed.
std::vector<Mat3> vertex_gradients(const TetMesh& mesh, const std::vector<double>& solid_share,
                                   const std::vector<Vec3>& moved) {
  std::vector<Mat3> sums(mesh.vertices.size(), Mat3{{{{}, {}, {}}}});
  std::vector<double> weights(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Mat3 f = edges_of(mesh.tets[t], moved) * inverse(edges_of(mesh.tets[t], mesh.vertices));
    for (const std::uint32_t v : mesh.tets[t]) {
      for (int row = 0; row < 3; ++row) sums[v].rows[row] += solid_share[t] * f.rows[row];
      weights[v] += solid_share[t];
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (moved[v] == mesh.vertices[v]) sums[v] = Mat3{};
    else
      for (Vec3& row : sums[v].rows) row = row / weights[v];
  }
  return sums;
}

}  // namespace

Result<SurfaceMotion> SurfaceMotion::make(const Cage& cage, const TriangleMesh& surface) {
  SurfaceMotion motion;
  motion.rest_ = cage.mesh();
  motion.solid_share_ = cage.solid_share();
  motion.surface_ = surface;
  motion.points_.reserve(surface.vertices.size());
  for (const Vec3& vertex : surface.vertices) {
    const auto point = cage.embed(vertex);
    if (!point)
      return fail(ErrorCode::internal, fmt::format("the cage does not hold the vertex ({:.6g}, {:.6g}, {:.6g})",
                                                   vertex.x, vertex.y, vertex.z));
    motion.points_.push_back(*point);
  }
  return motion;
}

TriangleMesh SurfaceMotion::moved(const std::vector<Vec3>& moved_mm) const {
  const TetMesh& mesh = rest_;
  assert(moved_mm.size() == mesh.vertices.size());
  const std::vector<Mat3> gradients = vertex_gradients(mesh, solid_share_, moved_mm);
  TriangleMesh out = surface_;
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const TetMesh::Tet& tet = mesh.tets[points_[n].tet];
    const Vec3 x = surface_.vertices[n];
    Vec3 shift;  // rather than the place: exact where nothing moves
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 v = mesh.vertices[tet[k]], by = moved_mm[tet[k]] - v, from = x - v;
      shift += points_[n].weights[k] * (by + 0.5 * (gradients[tet[k]] * from - from));
    }
    out.vertices[n] = x + shift;
  }
  return rounded_to_float(std::move(out));
}

}  // namespace aplomb
