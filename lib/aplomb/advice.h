#pragma once

#include "aplomb/balance/poses.h"
#include "aplomb/core/job.h"
#include "aplomb/input.h"
#include "aplomb/report/report.h"
#include "aplomb/stand_options.h"

namespace aplomb {

/// Adds to the report what would make a solid stand that carving could not: half the wall, a pedestal, a wider base.
///
/// \return cancelled. \par Cost  a carving's bound on a coarse grid.
Result<void> add_advice(Report& report, const Input& input, const JointProblem& joint, const StandOptions& options,
                        const Job& job);

/// Adds what ceilings that print left undone; `reaches`: whether it holds with them.
void add_ceiling_hints(Report& report, bool reaches);

/// Adds a hint for every point to hang from that is off the model.
void note_loose_attachments(Report& report, const TriangleMesh& mesh);

}  // namespace aplomb
