#pragma once

#include <span>

#include "aplomb/core/stage_clock.h"
#include "aplomb/input.h"
#include "aplomb/inserts/place_chooser.h"
#include "aplomb/report/report.h"
#include "aplomb/stand_options.h"

// Pockets for coins and balls, and the balance with them in.

namespace aplomb {

/// A solid with pockets: its outer triangles first, as they came, then the pockets, closed voids with inserts in them.
struct Inserted {
  Input input;
  InsertFigures figures;
  double wall_mm = 0;    ///< least distance from a pocket to the surface
  bool reaches = false;  ///< every pose as asked, with nothing carved
};

/// Puts inserts where they help most: for CarveAim::least the fewest that are found to do, else as many as there are.
/// Where they do not do by themselves, all that help are put in; carving sees the pockets as voids of the solid, and
/// keeps the wall to them.
///
/// \pre  options.inserts is not empty, find_problem(options) is.
/// \return unusable_input where no pocket fits anywhere; invalid_option where options.deform is not never, or the
///         process is not fdm: a print must pause to take them in; cancelled.
Result<Inserted> with_inserts(const Input& input, const StandOptions& options, StageClock& clock, const Job& job);

/// Inserts as so much of the solid's material as weighs what they do.
Moments inserts_as_solid(std::span<const Region> inserts, const StandOptions& options);

}  // namespace aplomb
