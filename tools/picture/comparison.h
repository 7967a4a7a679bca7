#pragma once

#include <vector>

#include "aplomb/balance/poses.h"
#include "aplomb/core/job.h"
#include "picture.h"

namespace aplomb::picture {

/// A model in every pose asked of it, a row each: as it came, cut open, and as it became, with what is measured of it,
/// its centre of mass and its support polygon or the threads it hangs from. A figure stands upright also where it would
/// fall, so that what was bent can be compared; a body hangs as it comes to rest. The marks, in the meshes' own
/// coordinates, are drawn on what it became, and `inserts`, which lie in its voids, are as so much of its material.
///
/// \pre  poses is not empty; size, the pixels across one picture, > 0.
/// \return unusable_input for a mesh without positive volume; what measure_standing() returns; cancelled.
/// \par Cost  about a second of CPU for each picture of 500 pixels.
Result<Image> before_and_after(const TriangleMesh& before, const TriangleMesh& after, const std::vector<Pose>& poses,
                               int size, const std::vector<Mark>& marks = {}, const Job& job = {},
                               const Moments& inserts = {});

/// The same without an after: as it came, and cut open.
Result<Image> as_it_is(const TriangleMesh& mesh, const std::vector<Pose>& poses, int size,
                       const std::vector<Mark>& marks = {}, const Job& job = {});

}  // namespace aplomb::picture
