#pragma once

#include <span>
#include <vector>

#include "aplomb/printability/cavities.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/rules.h"

namespace aplomb {

/// The cavities as the rules' void.hole_mm finds them; where a process asks for no holes (fdm: nothing has to get out),
/// closed shells alone. Errors: those of find_cavities().
Result<std::vector<Cavity>> find_cavities(const PrintedSolid& printed, const Rules& rules, const Job& job = {});

/// For the check void.closed: a place for each cavity that no ball of diameter void.hole_mm gets out of, measured 1,
/// largest first; where all are open, one place measured 0. The places' sum is the count.
std::vector<Place> void_closed(std::span<const Cavity> cavities, const Rules& rules);

/// For the check void.holes: the number of holes of each cavity that is not closed, fewest first; those that are below
/// the limit, or the worst alone; a single hole of void.lone_hole_mm counts as enough. The place is the widest hole.
std::vector<Place> void_holes(std::span<const Cavity> cavities, const Rules& rules);

/// For the check void.hole_place, in mm, worst first; of each cavity that is not closed:
/// - sla: what stays in it, and the air that stays: the larger of how far the lowest hole's lower lip lies above the
///   cavity's lowest point, and of how far the highest hole's upper lip lies below its highest point. The place is that
///   point.
/// - powder, binder: how much farther apart the two holes that are farthest apart should be: what is missing to half
///   the cavity's diagonal; of a single hole, all of it, and nothing where it is enough alone. The place is the widest
///   hole.
/// The rest as in void_holes().
std::vector<Place> void_hole_place(std::span<const Cavity> cavities, const Rules& rules);

}  // namespace aplomb
