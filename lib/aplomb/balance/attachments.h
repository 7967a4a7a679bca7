#pragma once

#include <vector>

#include "aplomb/balance/hanging_pose.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// A point to hang from that is not on the model: nobody can tie a thread there.
struct LooseAttachment {
  Vec3 at_mm;
  double distance_mm = 0;  ///< from the surface
};

/// The pose's points that are outside the model and farther from it than 0.5 % of its diagonal.
/// \pre mesh is closed and oriented.
std::vector<LooseAttachment> loose_attachments(const TriangleMesh& mesh, const HangingPose& pose);

}  // namespace aplomb
