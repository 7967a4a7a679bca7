#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "aplomb/balance/poses.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/deform/regions.h"
#include "aplomb/holes/hole.h"

namespace aplomb {

/// Where no hole may be.
struct HoleFences {
  std::span<const Pose> poses{};   ///< what touches the plate, and what hangs
  std::vector<BallRegion> kept{};  ///< no mouth in or near them
};

/// A part of a void that must not be carved, for no hole reaches it.
struct DeadEnd {
  Vec3 seed_mm;                                               ///< in the void
  double below_mm = std::numeric_limits<double>::infinity();  ///< what hangs together with the seed below this height
};

struct HoleChoice {
  std::vector<Hole> holes;
  std::vector<DeadEnd> dead_ends;  ///< none: every void has the holes that it needs
};

/// Chooses escape holes for the voids of a solid: straight channels through the wall which a ball of demand.bore_mm
/// passes all the way.
///
/// - Liquid (demand.drains): at each dip of a void a hole whose lower lip is at most 0.4 cup_mm above the dip's bottom
///   on the whole way out, and a vent as near to the void's top as can be, within place_mm if possible.
/// - Powder: those that are farthest apart for how well they are hidden: by half the diagonal of the void's box if
///   possible.
///
/// Of the places that serve, the one with the shortest channel and the mouth that looks down most. Demanded of each:
/// demand.wall_mm of material beside the channel (away from its mouth, which is smooth enough that the surface runs
/// through it as one disc), free space before the mouth, no mouth on what touches the plate, near where a thread is
/// fixed or in a kept ball, and as much between two holes as beside one. `earlier` holes that still serve are taken.
///
/// \param voids  closed surfaces in `outer`, wound outward from the void, no part narrower than demand.bore_mm.
/// \post  prism_of() of the holes do not meet.
/// \return cancelled.
/// \par Cost  0.1 to 1 s a void.
Result<HoleChoice> choose_holes(const TriangleMesh& outer, std::span<const TriangleMesh> voids,
                                const HoleDemand& demand, const HoleFences& fences, std::span<const Hole> earlier = {},
                                const Job& job = {});

}  // namespace aplomb
