#pragma once

#include <functional>
#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/volume/solid_volume.h"

namespace aplomb {

/// A part of a solid that is not to be carved, though the wall would allow it.
struct KeptPart {
  Box3 box_mm;                           ///< holds all of it
  std::function<double(Vec3)> depth_mm;  ///< distance to its surface, positive inside; safe to call from any thread
};

/// The same volume without what is kept: phi raised to the depth in any part. Where a part's surface is plane, phi's
/// zero is, too. The wall's guarantee holds, for phi is nowhere lowered.
///
/// \par Cost  O(blocks of the region in the parts' boxes).
SolidVolume without(const SolidVolume& volume, const std::vector<KeptPart>& parts);

/// What lies in a box.
KeptPart kept_box(const Box3& box_mm);

}  // namespace aplomb
