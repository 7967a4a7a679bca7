#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/slices.h"

namespace aplomb {

/// "void.base": the least floor under a void, mm.
///
/// The least height above the plate of a void's surface over the first layer's contact with the plate: the material
/// between, which is the floor that the bottom layers make. Exact on the triangles. What does not lie over the contact
/// has a wall below it and not a floor ("wall.void_outer").
///
/// \return A place for each void over the contact, where the process has the check. third_party, cancelled.
/// \par Cost  O(n log n) for n triangles of voids, and a set operation for each that may be the lowest.
Result<std::vector<Place>> measure_void_base(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                             const Job& job = {});

}  // namespace aplomb
