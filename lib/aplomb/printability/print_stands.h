#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/slices.h"

namespace aplomb {

/// "print.stands": the least share of the support that is left while it is printed, by layer.
///
/// When layer k has been printed, each body that is connected by then stands by itself on the convex hull H of its
/// parts of the first layer. Its share is
///
///     min over edges of H (distance of its centre of mass, seen from above, inside the edge) / (radius of H's largest
///     inscribed circle)
///
/// 1 at the best place, 0 over an edge, negative where it topples. What hangs in mid-air by then has no support to lose
/// and is left out, and so is what glues a print to its plate. Infill does not count: the solid is full.
///
/// \return Places where the process has the check: where toppling, one for each run of layers. third_party, cancelled.
/// \par Cost  O(parts) but for the links between layers (`detail/growth.h`).
Result<std::vector<Place>> measure_print_stands(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                                const Job& job = {});

}  // namespace aplomb
