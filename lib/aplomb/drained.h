#pragma once

#include "aplomb/attempt.h"

// Escape holes in a carved shell, and the balance with them in.

namespace aplomb {

/// What the process asks of escape holes; nothing where none are asked for, or wanted.
std::optional<HoleDemand> hole_demand(const StandOptions& options);

/// No void narrower than a hole, or smaller than is worth one, where holes are to be cut.
StandOptions with_voids_for_holes(StandOptions options);

/// Cuts the escape holes that the process asks for through an attempt's shell. What the channels take is taken from the
/// solid that is carved, and carved again until the drilled shell's own triangles reach the angle; voids that no hole
/// gets to, and dead ends of voids that none drains, are not carved. Where holes cannot be cut a hint of the attempt
/// says so; where it no longer stands with them, `carving.reaches` is false (and the shell left out, unless a best
/// effort was asked for).
///
/// \pre made.shell and made.volume are set. \return as choose_holes(), drill(), carve() and build_shell().
Result<Attempt> drained(Attempt made, const Input& input, const StandOptions& options, StageClock& clock,
                        const Job& job);

}  // namespace aplomb
