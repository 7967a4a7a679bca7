#include "aplomb/balance/poses.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "aplomb/balance/hanging_rows.h"

namespace aplomb {
namespace {

Result<BalanceProblem> rows_of(const TriangleMesh& outer, const Pose& pose, RowKind kind) {
  if (const HangingPose* hanging = pose.hanging())
    return hanging_rows(hanging->attachments_mm, hanging->up, hanging->least_drop_mm);
  const auto support = support_polygon(outer, *pose.standing());
  if (!support) return tl::unexpected(support.error());
  return standing_rows(*support, *pose.standing(), kind);
}

double t_of(const Pose& pose) {
  if (const HangingPose* hanging = pose.hanging()) return hanging_t(*hanging);
  return std::tan(pose.standing()->required_tip_rad);
}

}  // namespace

Vec3 Pose::up() const {
  return std::visit([](const auto& pose) { return pose.up; }, way);
}

std::string find_problem(std::span<const Pose> poses) {
  if (poses.empty()) return "the number of poses is 0 but must be 1 or more";
  for (const Pose& pose : poses)
    if (std::string problem = std::visit([](const auto& way) { return find_problem(way); }, pose.way); !problem.empty())
      return pose.name.empty() ? problem : "pose " + pose.name + ": " + problem;
  return {};
}

double JointProblem::angle_rad(double t) const { return bound_of == BoundOf::tilt ? -std::atan(t) : std::atan(t); }

Result<JointProblem> joint_problem(const TriangleMesh& outer, std::span<const Pose> poses, RowKind kind) {
  assert(find_problem(poses).empty());
  JointProblem joint;
  const bool is_surplus = poses.size() > 1;
  if (is_surplus) joint.bound_of = BoundOf::surplus;
  else if (poses.front().hanging()) joint.bound_of = BoundOf::tilt;
  if (!is_surplus) joint.required_t = t_of(poses.front());
  for (const Pose& pose : poses) {
    const auto rows = rows_of(outer, pose, kind);
    if (!rows) return tl::unexpected(rows.error());
    const double own_t = is_surplus ? t_of(pose) : 0;
    if (const HangingPose* hanging = pose.hanging(); hanging && is_surplus)
      joint.overlooked_t = std::max(joint.overlooked_t, std::tan(hanging->required_tilt_rad) + own_t);
    for (const BalanceRow& row : rows->rows) joint.problem.rows.push_back({row.at(own_t), row.b});
  }
  return joint;
}

double angle_at_rad(const Pose& pose, const JointProblem& joint, double t) {
  const double own_t = joint.bound_of == BoundOf::surplus ? t + t_of(pose) : t;
  return pose.hanging() ? -std::atan(own_t) : std::atan(own_t);
}

Result<PoseMeasure> measure_pose(const TriangleMesh& outer, std::span<const Region> body, const Pose& pose) {
  if (const HangingPose* hanging = pose.hanging()) return measure_hanging(body, *hanging);
  auto standing = measure_standing(outer, body, *pose.standing());
  if (!standing) return tl::unexpected(standing.error());
  return std::move(*standing);
}

bool holds(const Pose& pose, const PoseMeasure& measure, RowKind kind) {
  if (const HangingPose* asked = pose.hanging()) {
    const Hanging& hanging = std::get<Hanging>(measure);
    return hanging.pulls_all_threads && hanging.tilt_rad <= asked->required_tilt_rad;
  }
  const Stability& stability = std::get<Standing>(measure).stability;
  const double tip_rad = kind == RowKind::robust ? stability.robust_tip_rad : stability.tip_rad;
  return tip_rad >= pose.standing()->required_tip_rad;
}

}  // namespace aplomb
