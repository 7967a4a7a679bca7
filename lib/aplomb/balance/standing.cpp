#include "aplomb/balance/standing.h"

namespace aplomb {

Result<Standing> measure_standing(const TriangleMesh& outer, std::span<const Region> body, const StandingPose& pose) {
  const Result<SupportPolygon> support = support_polygon(outer, pose);
  if (!support) return tl::unexpected(support.error());
  const Result<std::array<ContactVariant, 3>> variants = contact_variants(outer, body, pose);
  if (!variants) return tl::unexpected(variants.error());
  Standing standing{*support, measure_stability(*support, body, pose), *variants, bounding_box(outer), std::nullopt};
  if (standing.stability.tip_rad < pose.required_tip_rad)
    standing.pedestal = smallest_pedestal(*support, standing.stability, pose);
  return standing;
}

}  // namespace aplomb
