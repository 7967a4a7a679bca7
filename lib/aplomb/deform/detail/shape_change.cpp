#include "aplomb/deform/detail/shape_change.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace aplomb::detail {

double mean_displacement_mm(const TetMesh& rest, const std::vector<double>& weights,
                            const std::vector<Vec3>& vertices) {
  double sum = 0, total = 0;
  for (std::size_t t = 0; t < rest.tets.size(); ++t) {
    Vec3 moved;
    for (const std::uint32_t v : rest.tets[t]) moved += vertices[v] - rest.vertices[v];
    sum += weights[t] * norm(moved) / 4;
    total += weights[t];
  }
  return sum / total;
}

double max_displacement_mm(const TetMesh& rest, const std::vector<Vec3>& vertices) {
  double most = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) most = std::max(most, norm(vertices[v] - rest.vertices[v]));
  return most;
}

double turn_rad(const Mat3& f) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) m.row(i) << f.rows[std::size_t(i)].x, f.rows[std::size_t(i)].y, f.rows[std::size_t(i)].z;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d r = svd.matrixU() * svd.matrixV().transpose();
  const Eigen::Vector3d axis(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  return std::atan2(axis.norm(), r.trace() - 1);
}

double max_turn_rad(const TetMesh& rest, const std::vector<TetShape>& shapes, const std::vector<Vec3>& vertices) {
  double most = 0;
  for (std::size_t t = 0; t < shapes.size(); ++t)
    most = std::max(most, turn_rad(deformation_gradient(shapes[t], rest.tets[t], vertices)));
  return most;
}

double volume_change_ratio(const TetMesh& rest, const std::vector<TetShape>& shapes, const std::vector<double>& weights,
                           const std::vector<Vec3>& vertices) {
  double sum = 0, total = 0;
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    sum += weights[t] * determinant(deformation_gradient(shapes[t], rest.tets[t], vertices));
    total += weights[t];
  }
  return sum / total - 1;
}

}  // namespace aplomb::detail
