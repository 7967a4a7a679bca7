#include "aplomb/balance/pose.h"

#include <cmath>
#include <sstream>

namespace aplomb {
namespace {

bool finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string sentence(const char* field, double value, const char* range) {
  std::ostringstream text;
  text << field << " is " << value << " but must be " << range;
  return text.str();
}

}  // namespace

std::string find_problem(const StandingPose& pose) {
  if (!finite(pose.up) || std::abs(norm(pose.up) - 1) > 1e-6) return sentence("the length of up", norm(pose.up), "1");
  if (!(pose.contact_height_mm > 0) || !std::isfinite(pose.contact_height_mm))
    return sentence("contact_height_mm", pose.contact_height_mm, "above 0");
  if (!(pose.required_tip_rad >= 0 && pose.required_tip_rad < std::numbers::pi / 2))
    return sentence("required_tip_rad", pose.required_tip_rad, "at least 0 and below pi/2");
  if (!(pose.xy_error_mm >= 0) || !std::isfinite(pose.xy_error_mm))
    return sentence("xy_error_mm", pose.xy_error_mm, "at least 0");
  for (const Contact& contact : pose.contacts) {
    if (!finite(contact.center_mm)) return "a contact's centre is not a number";
    if (!(contact.radius_mm >= 0) || !std::isfinite(contact.radius_mm))
      return sentence("a contact's radius_mm", contact.radius_mm, "at least 0");
  }
  return {};
}

PlateFrame plate_frame(Vec3 up, double plate_mm) {
  int dominant = 2;
  for (int axis = 0; axis < 2; ++axis)
    if (std::abs(up[axis]) > std::abs(up[dominant])) dominant = axis;
  Vec3 beside;
  beside[(dominant + 1) % 3] = 1;
  PlateFrame frame;
  frame.up = normalized(up);
  frame.x_axis = normalized(beside - dot(beside, frame.up) * frame.up);
  frame.y_axis = cross(frame.up, frame.x_axis);
  frame.plate_mm = plate_mm;
  return frame;
}

}  // namespace aplomb
