#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/slices.h"

namespace aplomb {

/// "void.bridge": the widest unsupported spans of the voids' ceilings, mm.
///
/// With V the voids at one layer, the material of the next that lies over V has nothing under it. What a ceiling as
/// steep as "void.slope" allows may overhang in a layer, a = layer / tan(slope), is left out. Of each connected piece
/// the span is
///
///     2 max { d(q, supported material) : q in the piece, d >= a },      supported material = what V leaves of the
///     layer below
///
/// the diameter of the largest circle round a point of it that no support reaches into. A printer lays the strands of a
/// bridge along its shortest way, so a slot is bridged across its width, and a round ceiling, which is the same every
/// way, across its diameter; material that ends in mid-air counts twice its reach. Good to 3e-3 mm. A flat
/// ceiling's span does not depend on the layer height; a ceiling that is flat for less than a layer counts with what
/// one layer sees of it: the top of a ball of radius R spans up to 2 sqrt(2 R layer).
///
/// \return Places where the process has the check; none where no ceiling is unsupported. third_party, cancelled.
/// \par Cost  Three set operations on the voids' loops a layer, a distance for each corner of a piece, and about 20 set
///            operations for each piece that may exceed the limit, or the widest.
Result<std::vector<Place>> measure_void_bridge(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                               const Job& job = {});

}  // namespace aplomb
