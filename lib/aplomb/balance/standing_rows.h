#pragma once

#include "aplomb/balance/balance_problem.h"
#include "aplomb/balance/support_polygon.h"

namespace aplomb {

enum class RowKind {
  nominal,  ///< the contact as drawn
  robust,   ///< every edge moved inward by pose.xy_error_mm
};

/// A row per edge of the support polygon, in its order, so that t = tan(tip angle):
///
///     a_i(x) = n_i . (x - p_i)  [- xy_error_mm]        b_i(x) = height of x above the plate
///
/// \post For every uniform body atan(largest_t) is Stability::tip_rad, or robust_tip_rad.
BalanceProblem standing_rows(const SupportPolygon& support, const StandingPose& pose, RowKind kind);

}  // namespace aplomb
