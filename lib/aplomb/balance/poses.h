#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/balance/hanging.h"
#include "aplomb/balance/standing.h"
#include "aplomb/balance/standing_rows.h"

namespace aplomb {

/// One way in which a solid is to hold, on a plate or on threads.
struct Pose {
  std::string name{};  ///< for the report; none: "pose 1"
  std::variant<StandingPose, HangingPose> way{};

  const StandingPose* standing() const { return std::get_if<StandingPose>(&way); }
  const HangingPose* hanging() const { return std::get_if<HangingPose>(&way); }
  Vec3 up() const;
};

/// A sentence that names the pose, the field, its value and its range, or nothing. No pose at all is a problem.
std::string find_problem(std::span<const Pose> poses);

/// What a bound is of.
enum class BoundOf {
  tip,      ///< the tip angle of the only pose: none is larger
  tilt,     ///< the tilt of the only pose, which hangs: none is smaller
  surplus,  ///< of several poses, atan of what the tangents of all exceed those asked for: none is larger
};

/// The rows of all poses, to be reached at one t.
struct JointProblem {
  BalanceProblem problem;
  double required_t = 0;  ///< every pose holds as asked from here on
  BoundOf bound_of = BoundOf::tip;
  /// Of a surplus: measured, all may exceed theirs by so much more than t, for what directions of threads overlook.
  double overlooked_t = 0;

  /// The angle that t stands for: a tilt is the smaller the better, and t the larger.
  double angle_rad(double t) const;
  /// The angle that nothing exceeds, where no t above bound_t can be reached.
  double bound_rad(double bound_t) const { return angle_rad(bound_t + overlooked_t); }
};

/// Unites the rows of the poses. A single pose keeps its own t: tan(tip angle), or -tan(tilt). Of several, each with
/// its own t_p asked for, t is what all exceed theirs by:
///
///     a_i - (t + t_p) b_i        required_t = 0, BoundOf::surplus
///
/// \pre  find_problem(poses) is empty.
/// \return as support_polygon.
Result<JointProblem> joint_problem(const TriangleMesh& outer, std::span<const Pose> poses, RowKind kind);

/// What every body that holds the joint problem at t reaches in one of its poses: a tip angle that is no smaller, or a
/// tilt that is no larger (from one thread: but for the 2 % that sixteen directions overlook).
///
/// \pre `joint` is of poses among which `pose` is.
double angle_at_rad(const Pose& pose, const JointProblem& joint, double t);

/// How a body holds in a pose: Standing of a standing one, Hanging of a hanging one.
using PoseMeasure = std::variant<Standing, Hanging>;

/// \pre  find_problem({&pose, 1}) is empty; `body` as in measure_standing().
/// \return as support_polygon.
Result<PoseMeasure> measure_pose(const TriangleMesh& outer, std::span<const Region> body, const Pose& pose);

/// Whether the angle that the pose asks for is reached (RowKind::robust: by the robust tip angle).
/// \pre `measure` is of this pose.
bool holds(const Pose& pose, const PoseMeasure& measure, RowKind kind);

}  // namespace aplomb
