#include "aplomb/deform/detail/newton_model.h"

namespace aplomb::detail {
namespace {

double inner(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

}  // namespace

NewtonModel::NewtonModel(const adapters::SparseCholesky& factors, const FreeVertices& free,
                         const std::vector<Vec3>& gradient, const Moments& body,
                         const std::array<std::vector<Vec3>, 4>& slopes)
    : body_(body) {
  std::vector<double> right = free.gather(gradient);
  for (const auto& slope : slopes) {
    const std::vector<double> column = free.gather(slope);
    right.insert(right.end(), column.begin(), column.end());
  }
  const std::vector<double> solved = factors.solve(right, 5);
  unheeding_ = free.scatter(solved.data());
  for (Vec3& d : unheeding_) d = -d;
  const Vec3& first = body.first_mm4;
  response_.unbalanced = {body.volume_mm3, first.x, first.y, first.z};
  for (std::size_t m = 0; m < 4; ++m) {
    answers_[m] = free.scatter(solved.data() + (m + 1) * std::size_t(free.unknowns()));
    response_.unbalanced[m] += inner(slopes[m], unheeding_);
    for (std::size_t k = 0; k <= m; ++k)
      response_.softness[m][k] = response_.softness[k][m] = inner(slopes[k], answers_[m]);
  }
}

NewtonStep NewtonModel::step(const BalanceProblem& rows, double t) const {
  const RowForces forces = row_forces(rows, t, body_, response_);
  NewtonStep step{unheeding_, t, forces.price};
  for (std::size_t m = 0; m < 4; ++m)
    for (std::size_t v = 0; v < step.displacement.size(); ++v)
      step.displacement[v] += forces.on_moments[m] * answers_[m][v];
  return step;
}

}  // namespace aplomb::detail
