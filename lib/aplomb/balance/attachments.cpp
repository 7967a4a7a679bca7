#include "aplomb/balance/attachments.h"

#include "aplomb/adapters/embree/surface_distance.h"

namespace aplomb {

std::vector<LooseAttachment> loose_attachments(const TriangleMesh& mesh, const HangingPose& pose) {
  const double reach_mm = 0.005 * bounding_box(mesh).diagonal();
  const adapters::SurfaceDistance surface(rounded_to_float(mesh));
  std::vector<LooseAttachment> loose;
  for (const Vec3& point : pose.attachments_mm)
    if (const auto nearest = surface.closest(point); nearest.distance_mm > reach_mm && !surface.inside(point, nearest))
      loose.push_back({point, nearest.distance_mm});
  return loose;
}

}  // namespace aplomb
