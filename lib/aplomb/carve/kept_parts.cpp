#include "aplomb/carve/kept_parts.h"

#include <algorithm>

namespace aplomb {

KeptPart kept_box(const Box3& box) {
  return {box, [box](Vec3 p) {
            double depth = std::min(p.x - box.min.x, box.max.x - p.x);
            depth = std::min({depth, p.y - box.min.y, box.max.y - p.y});
            return std::min({depth, p.z - box.min.z, box.max.z - p.z});
          }};
}

}  // namespace aplomb
