#pragma once

#include <array>
#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/mesh/mass_properties.h"

namespace aplomb::detail {

/// Volume and first moments as one vector.
using Moments4 = std::array<double, 4>;

/// How the rows answer to a step: the rows are linear in four moments, so four solves serve any number of them.
struct MomentResponse {
  Moments4 unbalanced{};             ///< the moments after the step that heeds no row
  std::array<Moments4, 4> softness;  ///< how the moments answer to a force on each of them: D H^-1 D^T
};

/// What the rows add to the unheeding step.
struct RowForces {
  Moments4 on_moments{};  ///< the force on each moment: the step adds  H^-1 D^T on_moments
  double price = 0;       ///< by how much the least energy grows with t: the sum of the multipliers
};

/// Solves  min over steps of the model energy  such that  g_i(moments, t) / b_i >= 0  exactly, by the dual:
///
///     min over y >= 0 of  y^T S y / 2 + y^T g,    S = A softness A^T,  g = A unbalanced
///
/// an active-set method (Lawson and Hanson 1974); at most four rows are active.
/// `body` (before the step) gives the b_i that scale the rows. \pre b_i(body) > 0 or is nearly so.
RowForces row_forces(const BalanceProblem& rows, double t, const Moments& body, const MomentResponse& response);

}  // namespace aplomb::detail
