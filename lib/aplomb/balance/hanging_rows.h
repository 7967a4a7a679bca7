#pragma once

#include <span>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/core/error.h"

namespace aplomb {

/// The rows of a body that hangs from one or two points, with t = -tan(tilt): maximising t levels it.
///
/// From one point p, sixteen directions n_j along the horizon (which overlook at most 2 % of tan(tilt)):
///
///     a_j(x) = -n_j . (x - p)        b_j(x) = drop of x below p
///
/// From two points, the axis through both: two such rows across it, b_j the drop below the axis, and two rows
/// with b = 0 that keep the centre of mass between them, so that both threads pull.
///
/// \pre  up is a unit vector; the body's centre of mass lies below the points.
/// \return invalid_option for another number of points, or for two of which one is straight above the other.
Result<BalanceProblem> hanging_rows(std::span<const Vec3> attachments_mm, Vec3 up);

}  // namespace aplomb
