#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/rules.h"

namespace aplomb {

/// The least wall between the voids and the outside, in mm, for the check wall.void_outer: the exact least distance of
/// the surfaces. A wall is thin by volume where opening the solid by a ball of diameter t leaves something out. Let a
/// and b be the nearest points of two surfaces, w apart: the segment ab lies in the solid and is normal to both. Where
/// the surface is smooth at a, a ball in the solid that touches it there has its centre on ab and cannot reach past b,
/// so the largest has the diameter w: a is left out exactly when w < t. Where a and b are corners or edges, larger
/// balls can touch them from aside: there the distance is the stricter of the two.
///
/// \return A place for each separate spot that is below the mildest limit, worst first, or the worst place alone; none
///         without voids. Measured is the least of the samples there (they are a quarter of the limit apart), for the
///         worst spot the exact distance, at most 1e-4 below it. Errors: cancelled.
/// \par Cost  measure_wall(), and a distance per sample of what is thin.
Result<std::vector<Place>> wall_void_outer(const PrintedSolid& printed, const Rules& rules, const Job& job = {});

/// The same between each two voids, for the check wall.void_void.
Result<std::vector<Place>> wall_void_void(const PrintedSolid& printed, const Rules& rules, const Job& job = {});

/// The thinnest places of the outer shells, in mm, for the check wall.thin: at a point of the surface, the thickness is
/// the diameter of the least ball that touches it there from inside and touches, across the solid, a surface which
/// faces the other way (normals at least 160 degrees apart). That is the largest ball inside that touches the point, by
/// which opening leaves it out or not, wherever two opposite sides hold that ball. Where convex edges or corners hold
/// it, as near every edge of a cube, nothing is thin, and facets of a round rod do not count as edges. A wedge of less
/// than 20 degrees is thin at its edge. Samples are 0.4 of the mildest limit t apart (farther where that would be more
/// than 250,000: then spots narrower than that may be missed), and spots of less than 4 t^2 of surface (two t^2 a side)
/// count as slivers.
///
/// \return A place for each separate spot below the mildest limit, worst first, or the worst place alone (of 8192
///         samples, where that is more than twice the limit); none where no two sides are opposite, as in a
///         tetrahedron. Errors: cancelled.
/// \par Cost  a query (1 to 3 us) per sample, shared by the threads allowed; more the thicker the thinnest place is.
Result<std::vector<Place>> wall_thin(const PrintedSolid& printed, const Rules& rules, const Job& job = {});

}  // namespace aplomb
