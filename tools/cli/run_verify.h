#pragma once

#include "aplomb/core/job.h"
#include "arguments.h"

namespace aplomb::cli {

/// `aplomb verify`: leaves the G-code as it is, so that a slicer may call it as a post-processing script.
/// \return the exit code: 0, 3 where something would topple, 6 where it stands and is not what the report told.
int run_verify(const Arguments& a, const Job& job);

}  // namespace aplomb::cli
