#pragma once

#include <optional>
#include <string>

#include "aplomb/core/error.h"
#include "aplomb/printability/finding.h"
#include "aplomb/report/report.h"
#include "aplomb/stand_options.h"

namespace aplomb {

/// How a run ends: the exit code of the program, and what a call of the C library returns.
enum class Ending {
  stands = 0,  ///< or prints
  usage = 1,
  unusable_input = 2,
  cannot_stand = 3,
  cancelled = 4,
  over_budget = 5,
  does_not_print = 6,
  internal = 7,
};

Ending ending_of(const Error& error);

/// Of a `stand` or a `check`: a pose that does not hold comes before what does not print.
Ending ending_of(const Report& report);

/// Of a `validate`.
Ending ending_of(const Judgement& judgement);

/// Why what was made is not to be given out, as a sentence: it would not print where the model as it came did, or what
/// was measured falls short, and the best effort was not asked for. Nothing where it may.
///
/// \pre report is of measure_output().
std::optional<std::string> refusal(const Report& report, const StandOptions& options);

}  // namespace aplomb
