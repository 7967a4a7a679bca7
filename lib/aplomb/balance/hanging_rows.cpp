#include "aplomb/balance/hanging_rows.h"

#include <cmath>
#include <numbers>

#include "aplomb/balance/pose.h"

namespace aplomb {
namespace {

/// n . (x - p).
AffineForm along(Vec3 n, Vec3 p) { return {-dot(n, p), n}; }

BalanceProblem from_one(Vec3 attachment_mm, const PlateFrame& frame) {
  constexpr int directions = 16;
  BalanceProblem problem;
  for (int j = 0; j < directions; ++j) {
    const double angle = 2 * std::numbers::pi * j / directions;
    const Vec3 n = frame.direction({std::cos(angle), std::sin(angle)});
    problem.rows.push_back({along(-n, attachment_mm), along(-frame.up, attachment_mm)});
  }
  return problem;
}

}  // namespace

Result<BalanceProblem> hanging_rows(std::span<const Vec3> attachments_mm, Vec3 up) {
  const PlateFrame frame = plate_frame(up, 0);
  if (attachments_mm.size() == 1) return from_one(attachments_mm[0], frame);
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
  return BalanceProblem{
      {{along(across, p), drop}, {along(-across, p), drop}, {along(from_p_to_q, p), {}}, {along(-from_p_to_q, q), {}}}};
}

}  // namespace aplomb
