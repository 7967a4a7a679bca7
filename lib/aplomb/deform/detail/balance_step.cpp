#include "aplomb/deform/detail/balance_step.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace aplomb::detail {
namespace {

/// min y^T S y / 2 + y^T g over y >= 0, S positive semidefinite.
Eigen::VectorXd nonnegative_minimum(const Eigen::MatrixXd& s, const Eigen::VectorXd& g) {
  const Eigen::Index n = g.size();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> active;
  const double tolerance = 1e-12 * (1 + g.cwiseAbs().maxCoeff());
  const auto minimum_over_active = [&] {
    Eigen::MatrixXd part = s(active, active);
    part.diagonal() *= 1 + 1e-13;
    Eigen::VectorXd all = Eigen::VectorXd::Zero(n);
    const Eigen::VectorXd right = -g(active);
    const Eigen::VectorXd solved = part.ldlt().solve(right);
    all(active) = solved;
    return all;
  };
  for (Eigen::Index round = 0; round < 10 * n + 20; ++round) {
    const Eigen::VectorXd slack = g + s * y;
    Eigen::Index worst = -1;
    for (Eigen::Index i = 0; i < n; ++i)
      if (std::find(active.begin(), active.end(), i) == active.end() && slack[i] < -tolerance &&
          (worst < 0 || slack[i] < slack[worst]))
        worst = i;
    if (worst < 0) return y;
    active.push_back(worst);
    while (!active.empty()) {
      const Eigen::VectorXd target = minimum_over_active();
      double reach = 1;  // as far towards the target as no multiplier turns negative
      for (const Eigen::Index i : active)
        if (target[i] <= 0) reach = std::min(reach, y[i] / std::max(y[i] - target[i], 1e-300));
      y += reach * (target - y);
      if (reach >= 1) break;
      std::erase_if(active, [&](Eigen::Index i) {
        const bool leaves = target[i] <= 0 && y[i] <= 1e-14 * y.maxCoeff();
        if (leaves) y[i] = 0;
        return leaves;
      });
    }
    if (std::find(active.begin(), active.end(), worst) == active.end()) return y;  // rounding: it cannot enter
  }
  return y;
}

}  // namespace

RowForces row_forces(const BalanceProblem& rows, double t, const Moments& body, const MomentResponse& response) {
  const auto n = Eigen::Index(rows.rows.size());
  Eigen::MatrixXd a(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    const BalanceRow& row = rows.rows[std::size_t(i)];
    const AffineForm form = row.at(t);
    const double scale = 1 / std::max(row.b(body), 1e-6 * std::pow(body.volume_mm3, 4.0 / 3));
    a.row(i) << form.constant * scale, form.gradient.x * scale, form.gradient.y * scale, form.gradient.z * scale;
  }
  Eigen::Matrix4d softness;
  Eigen::Vector4d unbalanced;
  for (int i = 0; i < 4; ++i) {
    unbalanced[i] = response.unbalanced[std::size_t(i)];
    for (int k = 0; k < 4; ++k) softness(i, k) = response.softness[std::size_t(i)][std::size_t(k)];
  }
  const Eigen::VectorXd y = nonnegative_minimum(a * softness * a.transpose(), a * unbalanced);
  const Eigen::Vector4d force = a.transpose() * y;
  return {{force[0], force[1], force[2], force[3]}, y.sum()};
}

}  // namespace aplomb::detail
