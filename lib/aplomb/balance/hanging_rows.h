#pragma once

#include <span>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/balance/hanging_pose.h"
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
/// A last row with b = 0 keeps the centre of mass least_drop_mm below the points: above them nothing hangs.
///
/// \pre  up is a unit vector; least_drop_mm >= 0.
/// \return invalid_option for another number of points, or for two of which one is straight above the other.
Result<BalanceProblem> hanging_rows(std::span<const Vec3> attachments_mm, Vec3 up, double least_drop_mm = 1);

/// The t from which on the pose's rows grant its required tilt: -tan(required_tilt_rad), and for one point a fiftieth
/// nearer to 0, for the sixteen directions.
double hanging_t(const HangingPose& pose);

}  // namespace aplomb
