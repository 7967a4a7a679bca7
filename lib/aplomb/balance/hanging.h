#pragma once

#include <span>

#include "aplomb/balance/hanging_pose.h"
#include "aplomb/balance/stability.h"

namespace aplomb {

/// How a body hangs. c is its centre of mass.
struct Hanging {
  double mass_g = 0;
  double volume_mm3 = 0;
  Vec3 com_mm;
  double tilt_rad = 0;             ///< in [0, pi]; over pi/2: c lies above the points, and it turns over
  double drop_mm = 0;              ///< of c below the points, along up
  bool pulls_all_threads = false;  ///< c lies between two points; one thread always pulls
};

/// Measures how a body hangs in a pose. From one point p the body turns until c is straight below p:
///
///     tilt = angle between up and p - c
///
/// From two, about the axis through both; tilt is the angle between up and the line from c to the axis, in the vertical
/// plane across the axis (the turn itself where both points are equally high).
///
/// \pre find_problem(pose) is empty; body is not empty, its regions have positive volume and density.
Hanging measure_hanging(std::span<const Region> body, const HangingPose& pose);

}  // namespace aplomb
