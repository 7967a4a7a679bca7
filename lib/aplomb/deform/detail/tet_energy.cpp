#include "aplomb/deform/detail/tet_energy.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace aplomb::detail {
namespace {

double squared_norm(const Mat3& m) {
  return dot(m.rows[0], m.rows[0]) + dot(m.rows[1], m.rows[1]) + dot(m.rows[2], m.rows[2]);
}

Mat3 combination(double s, const Mat3& a, double t, const Mat3& b) {
  return {{{s * a.rows[0] + t * b.rows[0], s * a.rows[1] + t * b.rows[1], s * a.rows[2] + t * b.rows[2]}}};
}

Eigen::Matrix3d to_eigen(const Mat3& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) result.row(i) << m.rows[i].x, m.rows[i].y, m.rows[i].z;
  return result;
}

Mat3 from_eigen(const Eigen::Matrix3d& m) {
  return {{{{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}}}};
}

}  // namespace

double TetEnergy::value(const Mat3& f) const {
  const double j = determinant(f);
  if (!(j > 0)) return std::numeric_limits<double>::infinity();
  const double psi = (squared_norm(f) + squared_norm(cofactor(f)) / (j * j)) / 2 - 3;
  return alpha * psi + beta / 2 * squared_norm(combination(1, f, -1, Mat3{})) + gamma / 2 * (j - 1) * (j - 1);
}

Mat3 TetEnergy::gradient(const Mat3& f) const {
  const double j = determinant(f);
  const Mat3 c = cofactor(f);
  const Mat3 g = combination(1 / j, c, 0, c);  // F^-T
  const Mat3 of_psi = combination(1, f, -1, g * (transposed(g) * g));
  const Mat3 of_pose = combination(1, f, -1, Mat3{});
  return combination(1, combination(alpha, of_psi, beta, of_pose), gamma * (j - 1), c);
}

// With F = U diag(s) V^T, an isotropic W(s) has three stretching modes u_i v_i^T mixed by d2W/ds2, and for each pair of
// axes a twist (u_i v_j^T - u_j v_i^T) / sqrt 2 with curvature (W_i + W_j) / (s_i + s_j) and a flip (with +) with
// (W_i - W_j) / (s_i - s_j); both quotients are divided out below, so that equal stretches are no special case.
std::array<TetEnergy::Mode, 9> TetEnergy::modes(const Mat3& f) const {
  const Eigen::Matrix3d deformation = to_eigen(f);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> stretches(deformation.transpose() * deformation);
  const Eigen::Matrix3d& v = stretches.eigenvectors();
  const Eigen::Vector3d s = stretches.eigenvalues().cwiseMax(1e-30).cwiseSqrt();
  const Eigen::Matrix3d u = deformation * v * s.cwiseInverse().asDiagonal();
  const double j = determinant(f);

  std::array<Mode, 9> modes;
  Eigen::Matrix3d of_stretches;
  for (int i = 0; i < 3; ++i) {
    const double inverse2 = 1 / (s[i] * s[i]);
    of_stretches(i, i) = alpha * (1 + 3 * inverse2 * inverse2) + gamma * j * j * inverse2;
    for (int k = 0; k < i; ++k) of_stretches(i, k) = of_stretches(k, i) = gamma * (2 * j - 1) * j / (s[i] * s[k]);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> mixed(of_stretches);
  for (int m = 0; m < 3; ++m)
    modes[std::size_t(m)] = {mixed.eigenvalues()[m] + beta,
                             from_eigen(u * mixed.eigenvectors().col(m).asDiagonal() * v.transpose())};
  for (int m = 0; m < 3; ++m) {
    const int i = (m + 1) % 3, k = (m + 2) % 3, twist_mode = 3 + 2 * m, flip_mode = twist_mode + 1;
    const double product = s[i] * s[k], cube = product * product * product;
    const double squares = s[i] * s[i] + s[k] * s[k];
    const double of_volume = gamma * (j - 1) * j / product;
    const Eigen::Matrix3d ik = u.col(i) * v.col(k).transpose(), ki = u.col(k) * v.col(i).transpose();
    const double twist = alpha * (1 - (squares - product) / cube) + of_volume;
    const double flip = alpha * (1 + (squares + product) / cube) - of_volume;
    modes[std::size_t(twist_mode)] = {twist + beta, from_eigen((ik - ki) * std::sqrt(0.5))};
    modes[std::size_t(flip_mode)] = {flip + beta, from_eigen((ik + ki) * std::sqrt(0.5))};
  }
  return modes;
}

}  // namespace aplomb::detail
