#pragma once

#include <array>
#include <optional>
#include <span>

#include "aplomb/balance/pedestal.h"
#include "aplomb/balance/stability.h"
#include "aplomb/balance/support_polygon.h"
#include "aplomb/core/vec.h"

namespace aplomb {

/// Everything that is said of how one body stands.
struct Standing {
  SupportPolygon support;
  Stability stability;
  std::array<ContactVariant, 3> variants;
  Box3 box_mm;                       ///< of the surface
  std::optional<Pedestal> pedestal;  ///< set when the tip angle is below pose.required_tip_rad
};

/// Measures a body in a pose. `outer` is the surface that touches the plate; a void changes `body` only.
///
/// \pre  find_problem(pose) is empty; body as in measure_stability().
/// \return as support_polygon.
Result<Standing> measure_standing(const TriangleMesh& outer, std::span<const Region> body, const StandingPose& pose);

}  // namespace aplomb
