#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/slices.h"

namespace aplomb {

/// "void.slope": the flattest slopes of the voids' ceilings that are no bridges, degrees from level.
///
/// A ceiling is what faces down into the void: outward normal n with n_z < 0, its slope acos(-n_z). Facets flatter than
/// the limit that share edges are a patch. A patch measures the slope that 1 mm2 of it is flatter than (our choice), so
/// that a single sliver of a triangle is no finding; smaller patches are left out. So are bridges, where the
/// process has "void.bridge": patches of which no point is farther, seen from above, than half the mildest limit of a
/// span from an edge where the surface goes down, which is where the patch rests. Where it goes up nothing holds it.
/// Where nothing is too flat, the slope that 1 mm2 of all other ceilings is flatter than. Angles are those of the
/// triangles: layers have no part in it.
///
/// \return Places where the process has the check; none where the voids have no ceiling but bridges.
///         third_party, cancelled.
/// \par Cost  O(n) for n triangles of voids, O(m log m) for a patch of m.
Result<std::vector<Place>> measure_void_slope(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                              const Job& job = {});

}  // namespace aplomb
