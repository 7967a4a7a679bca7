#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "aplomb/core/vec.h"

namespace aplomb {

/// How a solid is to hang, in the model's own coordinates, from one thread or from two that are both plumb.
struct HangingPose {
  Vec3 up{0, 0, 1};                    ///< unit vector, along the thread
  std::vector<Vec3> attachments_mm{};  ///< one or two, on the surface or inside; two not straight above each other
  double required_tilt_rad = std::numbers::pi / 90;  ///< in (0, pi/2); hangs level to this
  double least_drop_mm = 1;  ///< > 0; carving keeps the centre of mass this far below the points: nearer, it is no hold
};

/// A sentence that names the field, its value and its range, or nothing.
std::string find_problem(const HangingPose& pose);

}  // namespace aplomb
