#pragma once

#include <array>
#include <vector>

#include "aplomb/adapters/cholmod/sparse_cholesky.h"
#include "aplomb/balance/balance_problem.h"
#include "aplomb/deform/detail/balance_step.h"
#include "aplomb/deform/detail/cage_energy.h"

namespace aplomb::detail {

struct NewtonStep {
  std::vector<Vec3> displacement;  ///< of every vertex
  double t = 0;                    ///< at which the linearised rows hold after it
  double price = 0;                ///< by how much the least energy grows with t
};

/// The model of one iterate:  gradient . d + d^T H d / 2  under rows that are linear in d. Five solves make it; a step
/// for any t then costs next to nothing.
class NewtonModel {
 public:
  /// \pre `factors` hold H at the iterate. `body` are the moments there, `slopes` their derivatives.
  NewtonModel(const adapters::SparseCholesky& factors, const FreeVertices& free, const std::vector<Vec3>& gradient,
              const Moments& body, const std::array<std::vector<Vec3>, 4>& slopes);

  /// The model's exact minimiser under the rows at t.
  NewtonStep step(const BalanceProblem& rows, double t) const;

 private:
  Moments body_;
  MomentResponse response_;
  std::vector<Vec3> unheeding_;               // -H^-1 gradient
  std::array<std::vector<Vec3>, 4> answers_;  // H^-1 D^T: how the vertices answer to a force on each moment
};

}  // namespace aplomb::detail
