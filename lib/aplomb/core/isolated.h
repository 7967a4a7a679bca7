#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"

namespace aplomb {

struct IsolationLimits {
  double seconds = 30;           ///< wall clock; 0 and less: the work is not started
  std::size_t memory_mb = 4096;  ///< on top of what the process holds
};

/// Runs work that may crash, never end or eat all memory in a forked child, and returns the bytes it made. What the
/// child writes to stdout and stderr is lost. It has the locale "C" and no thread but its own: work must not use a
/// pool.
///
/// \return cancelled within 50 ms of job's word; over_budget when a limit was passed; third_party when the work threw
///         or crashed, with the reason.
/// \par Cost  A fork: 1 ms, and the pages that either side then writes to.
Result<std::string> run_isolated(const std::function<std::string()>& work, const IsolationLimits& limits,
                                 const Job& job = {}, std::string_view stage = "isolated");

}  // namespace aplomb
