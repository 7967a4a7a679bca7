#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/slices.h"

namespace aplomb {

/// "void.island": what starts in mid-air inside a void, mm2 of its largest layer before it is joined to something.
///
/// A part of a layer lies inside a void when more than half of it is over the voids of the layer below. It starts there
/// when nothing is under it (less than 1e-6 of it); for resin, which peels a part off that hangs by a corner, when less
/// than a quarter is held (UVtools). What grows to less than 0.1 mm2, a dot of a nozzle, before it is joined is a bump
/// of the surface and no island (our choice).
///
/// \return Places where the process has the check; none where there is no such part. third_party, cancelled.
/// \par Cost  Set operations only where a layer has two parts or more and one lies where a void was.
Result<std::vector<Place>> measure_void_island(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                               const Job& job = {});

}  // namespace aplomb
