#pragma once

#include "aplomb/balance/stability.h"

namespace aplomb {

/// A round disc to glue or print under a figure, centred at center_mm on the plate.
struct Pedestal {
  Vec3 center_mm;
  double radius_mm = 0;
  double thickness_mm = 0;
};

/// The smallest round pedestal on which the figure reaches pose.required_tip_rad: the smallest circle around the
/// support polygon and around the disc of radius (h + thickness_mm) tan(required) about the centre of mass c. The
/// figure stands on all of its contacts, and the pedestal's rim is nowhere nearer to c than the tip angle asks. The
/// pedestal's own mass is left out; it lies low, so it can only help.
///
/// \pre thickness_mm >= 0; stability was measured with this support.
Pedestal smallest_pedestal(const SupportPolygon& support, const Stability& stability, const StandingPose& pose,
                           double thickness_mm = 2);

}  // namespace aplomb
