#include "aplomb/deform/surface_motion.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/triangle_tree.h"

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

Vec3 SurfaceMotion::moved_point(std::size_t n, const std::vector<Vec3>& moved_mm,
                                const std::vector<Mat3>& gradients) const {
  const TetMesh::Tet& tet = rest_.tets[points_[n].tet];
  const Vec3 x = surface_.vertices[n];
  Vec3 shift;  // rather than the place: exact where nothing moves
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 v = rest_.vertices[tet[k]], by = moved_mm[tet[k]] - v, from = x - v;
    shift += points_[n].weights[k] * (by + 0.5 * (gradients[tet[k]] * from - from));
  }
  return x + shift;
}

Mat3 SurfaceMotion::gradient_at(std::size_t n, const std::vector<Mat3>& gradients) const {
  const TetMesh::Tet& tet = rest_.tets[points_[n].tet];
  Mat3 sum{{{{}, {}, {}}}};
  for (std::size_t k = 0; k < 4; ++k)
    for (int row = 0; row < 3; ++row) sum.rows[row] += points_[n].weights[k] * gradients[tet[k]].rows[row];
  return sum;
}

TriangleMesh SurfaceMotion::moved(const std::vector<Vec3>& moved_mm) const {
  assert(moved_mm.size() == rest_.vertices.size());
  const std::vector<Mat3> gradients = vertex_gradients(rest_, solid_share_, moved_mm);
  TriangleMesh out = surface_;
  tbb::parallel_for(std::size_t{0}, points_.size(),
                    [&](std::size_t n) { out.vertices[n] = moved_point(n, moved_mm, gradients); });
  return rounded_to_float(std::move(out));
}

Result<TriangleMesh> SurfaceMotion::moved_apart(const std::vector<Vec3>& moved_mm, const std::vector<bool>& held,
                                                const Job& job) const {
  const std::vector<Mat3> gradients = vertex_gradients(rest_, solid_share_, moved_mm);
  TriangleMesh out = moved(moved_mm);
  const double height = bounding_box(surface_).size().z;
  for (double radius = 0.01 * height; radius < 0.1 * height; radius *= 2) {
    const auto crossing =
        detail::crossing_triangles(out, detail::TriangleTree(out), std::vector<bool>(out.triangles.size()), job);
    if (!crossing) return tl::unexpected(crossing.error());
    std::vector<std::uint32_t> middles;  // far enough apart to serve all
    for (std::size_t t = 0; t < out.triangles.size(); ++t) {
      if (!(*crossing)[t]) continue;
      const Vec3 at = surface_.vertices[out.triangles[t][0]];
      const auto near = [&](std::uint32_t m) { return norm(surface_.vertices[m] - at) < 0.5 * radius; };
      if (std::ranges::none_of(middles, near)) middles.push_back(out.triangles[t][0]);
    }
    if (middles.empty()) break;
    for (const std::uint32_t m : middles) {
      const Vec3 from = surface_.vertices[m], to = moved_point(m, moved_mm, gradients);
      const Mat3 map = gradient_at(m, gradients);
      for (std::size_t n = 0; n < points_.size(); ++n) {
        const Vec3 x = surface_.vertices[n];
        const double out_of = norm(x - from) / radius;
        if (out_of >= 2 || held[n]) continue;
        const double share = out_of <= 1 ? 1 : 2 - out_of;
        out.vertices[n] += share * (to + map * (x - from) - out.vertices[n]);
      }
    }
    out = rounded_to_float(std::move(out));
  }
  return out;
}

}  // namespace aplomb
