#pragma once

#include <functional>

#include "aplomb/attempt.h"

namespace aplomb {

/// Carves what a volume allows and builds the shell, whether it reaches or not.
using CarveAgain = std::function<Result<Attempt>(const SolidVolume& allowed, const Job& job)>;

/// A carving whose voids print without supports: the judge finds nothing to fail or warn of in their ceilings
/// ("void.bridge", "void.slope", "void.island") nor in the walls between them ("wall.void_void"). Checks that are
/// waived or not made are left alone, and so is what is as bad in the voids that the model brought along.
///
/// What the judge finds is kept from being carved, and the rest is carved again, exactly, so that the certificate
/// speaks of what may be carved then: ribs under ceilings too wide and too flat (ribs_under()), pillars under what
/// starts in mid-air, fills where a wall is too thin. Of the rounds the one with the fewest findings is given, the
/// first of them; it ends after four, or two that found no fewer.
///
/// \pre  `as_carved` has its shell and volume.
/// \post Where there is nothing to shape it is `as_carved`, and `ceiling` says so.
/// \return as `carve_again`; cancelled, over_budget, third_party.
/// \par Cost  Judging a shell is about a third of building it; a round is a carving, a shell and a judgement.
Result<Attempt> with_printable_ceilings(const Attempt& as_carved, const Rules& rules, const CarveAgain& carve_again,
                                        const Job& job = {});

}  // namespace aplomb
