#pragma once

#include <vector>

#include "aplomb/core/pulse.h"
#include "aplomb/printability/detail/basins.h"

namespace aplomb::detail {

/// The narrowest place of the widest way between two basins.
struct Passage {
  double clearance_mm = 0;
  Vec3 at_mm;    ///< where it is met first, coming from basin a
  Vec3 along{};  ///< the way's direction there, from a to b, of length 1
};

/// Follows the widest way over the contact from basin a's peak to basin b's, then again on ever finer lattices round
/// the way found last, until the spacing is a sixtieth of the clearance, which is then less than 1.2 % too small.
/// Ends early with what it has when that is `enough_mm` or more, and with nothing where the pulse stopped.
///
/// \par Cost  20 to 200 ms, the more the longer the way is narrow.
Passage find_passage(const EmptySpace& space, const ClearanceLattice& lattice, const Basins& basins,
                     const Basins::Contact& contact, double enough_mm, const Pulse& pulse);

/// From a point uphill to where the clearance is largest nearby; the point itself where that leads out of the solid's
/// box, beyond which there is no end of it.
struct Peak {
  Vec3 at_mm;
  double clearance_mm = 0;
};
Peak climb(const EmptySpace& space, Vec3 from_mm, double step_mm);

}  // namespace aplomb::detail
