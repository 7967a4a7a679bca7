#include "aplomb/balance/hanging_pose.h"

#include <fmt/format.h>

#include <cmath>

namespace aplomb {
namespace {

bool finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

std::string find_problem(const HangingPose& pose) {
  if (!finite(pose.up) || std::abs(norm(pose.up) - 1) > 1e-6)
    return fmt::format("the length of up is {} but must be 1", norm(pose.up));
  const std::size_t points = pose.attachments_mm.size();
  if (points < 1 || points > 2)
    return fmt::format("the number of points to hang from is {} but must be 1 or 2", points);
  for (const Vec3& point : pose.attachments_mm)
    if (!finite(point)) return "a point to hang from is not a number";
  const Vec3 between = pose.attachments_mm.back() - pose.attachments_mm.front();
  const Vec3 level = between - dot(pose.up, between) * pose.up;
  if (points == 2 && norm(level) <= 1e-9 * norm(between))
    return "the two points to hang from lie one above the other; move one aside";
  if (!(pose.required_tilt_rad > 0 && pose.required_tilt_rad < std::numbers::pi / 2))
    return fmt::format("required_tilt_rad is {} but must be above 0 and below pi/2", pose.required_tilt_rad);
  if (!(pose.least_drop_mm > 0) || !std::isfinite(pose.least_drop_mm))
    return fmt::format("least_drop_mm is {} but must be above 0", pose.least_drop_mm);
  return {};
}

}  // namespace aplomb
