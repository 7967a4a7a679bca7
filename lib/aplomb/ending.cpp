#include "aplomb/ending.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>

namespace aplomb {

Ending ending_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::invalid_option:
      return Ending::usage;
    case ErrorCode::unusable_input:
    case ErrorCode::file_system:
      return Ending::unusable_input;
    case ErrorCode::cancelled:
      return Ending::cancelled;
    case ErrorCode::over_budget:
      return Ending::over_budget;
    default:
      return Ending::internal;
  }
}

Ending ending_of(const Report& report) {
  if (report.outcome == Outcome::best_effort || report.outcome == Outcome::falls) return Ending::cannot_stand;
  const bool is_spoilt = report.judgement && !report.judgement->new_failures().empty();
  return is_spoilt ? Ending::does_not_print : Ending::stands;
}

Ending ending_of(const Judgement& judgement) { return judgement.passes() ? Ending::stands : Ending::does_not_print; }

std::optional<std::string> refusal(const Report& report, const StandOptions& options) {
  assert(report.judgement);
  if (options.best_effort) return std::nullopt;
  const auto failures = report.judgement->new_failures();
  if (failures.empty()) {
    if (report.outcome != Outcome::best_effort) return std::nullopt;
    return "nothing was written; --best-effort writes it all the same";
  }
  return fmt::format(
      "nothing was written, for what carving makes of it would not print: {0}; --best-effort writes it all the same, "
      "and --waive {1} accepts a finding",
      fmt::join(failures, ", "), failures.front());
}

}  // namespace aplomb
