#include "aplomb/balance/hanging_rows.h"

#include <cmath>
#include <numbers>

#include "aplomb/balance/pose.h"

namespace aplomb {
namespace {

/// n . (x - p).
AffineForm along(Vec3 n, Vec3 p) { return {-dot(n, p), n}; }

constexpr int directions = 16;

BalanceProblem from_one(Vec3 attachment_mm, const PlateFrame& frame) {
  BalanceProblem problem;
  for (int j = 0; j < directions; ++j) {
    const double angle = 2 * std::numbers::pi * j / directions;
    const Vec3 n = frame.direction({std::cos(angle), std::sin(angle)});
    problem.rows.push_back({along(-n, attachment_mm), along(-frame.up, attachment_mm)});
  }
  return problem;
}

BalanceProblem with_drop_of(double least_drop_mm, BalanceProblem problem) {
  AffineForm drop = problem.rows.front().b;
  drop.constant -= least_drop_mm;
  problem.rows.push_back({drop, {}});
  return problem;
}

}  // namespace

Result<BalanceProblem> hanging_rows(std::span<const Vec3> attachments_mm, Vec3 up, double least_drop_mm) {
  const PlateFrame frame = plate_frame(up, 0);
  if (attachments_mm.size() == 1) return with_drop_of(least_drop_mm, from_one(attachments_mm[0], frame));
  if (attachments_mm.size() != 2)
    return fail(ErrorCode::invalid_option,
                "a figure hangs from one or two points; " + std::to_string(attachments_mm.size()) + " were given");
  const Vec3 p = attachments_mm[0], q = attachments_mm[1], rise = dot(frame.up, q - p) * frame.up;
  const Vec3 level = q - p - rise;
  const double span_mm = norm(level);
  if (span_mm <= 1e-9 * norm(q - p) || span_mm == 0)
    return fail(ErrorCode::invalid_option, "the two points to hang from lie one above the other; move one aside");
  const Vec3 from_p_to_q = level / span_mm, across = cross(frame.up, from_p_to_q);
  const double slope = dot(frame.up, rise) / span_mm;
  const AffineForm drop = along(-frame.up, p) + slope * along(from_p_to_q, p);
  return with_drop_of(least_drop_mm, {{{along(across, p), drop},
                                       {along(-across, p), drop},
                                       {along(from_p_to_q, p), {}},
                                       {along(-from_p_to_q, q), {}}}});
}

double hanging_t(const HangingPose& pose) {
  const double overlooked = pose.attachments_mm.size() == 1 ? std::cos(std::numbers::pi / directions) : 1;
  return -std::tan(pose.required_tilt_rad) * overlooked;
}

}  // namespace aplomb
