#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "aplomb/core/vec.h"

namespace aplomb {

/// A ball whose part of the surface may touch the plate; radius 0: the centre itself counts as a contact.
struct Contact {
  Vec3 center_mm{};
  double radius_mm = 0;

  friend bool operator==(const Contact&, const Contact&) = default;
};

/// How a solid is to stand, in the model's own coordinates: nothing is moved, `up` says which way is up.
struct StandingPose {
  Vec3 up{0, 0, 1};                 ///< unit vector, away from the plate
  std::vector<Contact> contacts{};  ///< what may touch the plate; none: whatever is low enough
  double contact_height_mm = 0.1;   ///< > 0; surface this far above the lowest point still touches (half a first layer)
  double required_tip_rad = std::numbers::pi / 18;  ///< in [0, pi/2); 10 degrees is IEC 60335-1's for everyday things
  double xy_error_mm = 0.2;  ///< >= 0; how far the printed contact's edge may lie inside the drawn one
};

/// A sentence that names the field, its value and its range, or nothing.
std::string find_problem(const StandingPose& pose);

/// Plate coordinates of a pose: x and y along the plate, height above it. Right-handed, orthonormal; exact
/// (no rounding at all but the plate's height) where `up` is a coordinate axis or its opposite, and the
/// identity for +z.
struct PlateFrame {
  Vec3 x_axis{1, 0, 0};
  Vec3 y_axis{0, 1, 0};
  Vec3 up{0, 0, 1};
  double plate_mm = 0;  ///< dot(up, p) of the points p of the plate

  Vec2 on_plate(Vec3 point_mm) const { return {dot(x_axis, point_mm), dot(y_axis, point_mm)}; }
  double height_mm(Vec3 point_mm) const { return dot(up, point_mm) - plate_mm; }
  Vec3 direction(Vec2 along_plate) const { return along_plate.x * x_axis + along_plate.y * y_axis; }
  Vec3 in_model(Vec2 point_mm, double height_mm = 0) const { return direction(point_mm) + (plate_mm + height_mm) * up; }
};

/// \pre up is not zero.
PlateFrame plate_frame(Vec3 up, double plate_mm);

}  // namespace aplomb
