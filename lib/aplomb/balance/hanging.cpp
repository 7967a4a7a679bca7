#include "aplomb/balance/hanging.h"

#include <cassert>
#include <cmath>

namespace aplomb {

Hanging measure_hanging(std::span<const Region> body, const HangingPose& pose) {
  assert(!body.empty() && find_problem(pose).empty());
  const BodyMass total = mass_of(body);
  Hanging hanging;
  hanging.volume_mm3 = total.volume_mm3;
  hanging.mass_g = total.mass_g;
  hanging.com_mm = total.com_mm;
  const Vec3 p = pose.attachments_mm.front(), q = pose.attachments_mm.back();
  Vec3 above = p;  // the point of attachment, or of the axis, that c is to come under
  if (pose.attachments_mm.size() == 2) {
    const Vec3 level = q - p - dot(pose.up, q - p) * pose.up;
    const double share = dot(level, hanging.com_mm - p) / squared_norm(level);
    above = p + share * (q - p);
    hanging.pulls_all_threads = share >= 0 && share <= 1;
  } else {
    hanging.pulls_all_threads = true;
  }
  const Vec3 thread = above - hanging.com_mm;
  hanging.drop_mm = dot(pose.up, thread);
  hanging.tilt_rad = std::atan2(norm(thread - hanging.drop_mm * pose.up), hanging.drop_mm);
  return hanging;
}

}  // namespace aplomb
