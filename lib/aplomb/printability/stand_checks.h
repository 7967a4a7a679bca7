#pragma once

#include <vector>

#include "aplomb/balance/standing.h"
#include "aplomb/core/error.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"

namespace aplomb {

/// How a solid stands while printed and after it.
struct StandMeasures {
  std::vector<Place> nominal;  ///< tip angle, degrees
  std::vector<Place> robust;   ///< at the worst of the tolerances, degrees
  std::vector<Place> trapped;  ///< with its closed voids full, degrees; none without voids
};

/// \param body  what stands: the print, and what lies in it. \pre as in measure_standing().
/// \param trapped_g_per_cm3  density of what stays in closed voids. \pre at least 0.
/// \return as support_polygon().
Result<StandMeasures> measure_stand(const PrintedSolid& printed, const StandingPose& pose, std::vector<Region> body,
                                    double trapped_g_per_cm3);

/// How a slicer fills a print.
struct Filling {
  double infill_ratio = 1;  ///< in [0, 1]
  double skin_mm = 1.35;    ///< what it lays solid round a void: measured with PrusaSlicer, 3 perimeters
};

/// What voids add to the printed mass, in percent of the mass without them (skinned likewise): a skin round each, less
/// the infill that would be there (Steiner's formula for the volume within skin_mm of a void, exact for convex ones):
///
///     (1 - f) (A s + M s^2 + 4/3 pi s^3) - f V,     A area, M integral of the mean curvature, V volume of the void
std::vector<Place> mass_gained_percent(const PrintedSolid& printed, const Filling& filling);

}  // namespace aplomb
