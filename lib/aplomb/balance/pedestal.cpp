#include "aplomb/balance/pedestal.h"

#include <cmath>

#include "aplomb/balance/detail/enclosing_circle.h"

namespace aplomb {

Pedestal smallest_pedestal(const SupportPolygon& support, const Stability& stability, const StandingPose& pose,
                           double thickness_mm) {
  const double reach_mm = (stability.com_height_mm + thickness_mm) * std::tan(pose.required_tip_rad);
  const detail::Circle circle =
      detail::enclosing_circle(support.corners_mm, {support.frame.on_plate(stability.com_mm), reach_mm});
  return {support.frame.in_model(circle.center_mm), circle.radius_mm, thickness_mm};
}

}  // namespace aplomb
