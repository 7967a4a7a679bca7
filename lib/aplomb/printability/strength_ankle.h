#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/slices.h"

namespace aplomb {

/// "strength.ankle": the largest stresses in level sections, MPa.
///
/// A section is everything at one layer that holds what is connected above it: one part, or several that share the load
/// as one beam (plane sections stay plane; what each leg of a frame bends by itself is left out). It carries the weight
/// W of all that falls off when it is cut, what hangs from above beside it included, at a lever r from the section's
/// centroid, and, where the top of the body is above it, a push of F = 10 N at that top, L above the section, in the
/// worst direction. With A the section's area, J the integral of q q^T about its centroid, q a point of its rim, the
/// largest compression or tension is
///
///     max over q of  F L |J^-1 q| + | W / A + W r . J^-1 q |
///
/// Beam theory holds a width away from a beam's ends, and a chip is no ankle, so sections are judged where what falls
/// off is 2 % of the volume or more and the plate and the top are farther than half the outline's width, sqrt(area /
/// pi). Both are our choice. What hangs in mid-air while it is printed is judged where it is held, above.
///
/// \pre density_g_per_cm3 > 0.
/// \return Places where the process has the check. third_party, cancelled.
/// \par Cost  O(points of all outlines) but for the links between layers (`detail/growth.h`).
Result<std::vector<Place>> measure_strength_ankle(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                                  double density_g_per_cm3, const Job& job = {});

}  // namespace aplomb
