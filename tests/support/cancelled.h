#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>
#include <set>
#include <string>

#include "aplomb/core/error.h"
#include "support/cost.h"
#include "support/patience.h"

/// Whether a run that is told to stop does, soon and with nothing but Cancelled to show. A run is any function of a Job
/// that returns a Result.
namespace aplomb::test {

constexpr double most_end_s = 0.2;
/// By the clock, since what waits for threads or a child process takes no CPU of its own; ten times as long, since
/// other programs may have the cores.
constexpr double most_end_wall_s = is_sanitized() ? 10 : 2;
/// Our aim is 0.1; a checked build may take twice that, one under a sanitizer several times.
constexpr double most_silence_s = is_sanitized() ? 1 : 0.2;

/// Lets a run go to its end, whatever that is, and asks that it is never silent for long: in one of five runs, for
/// others slow it down through caches and memory.
template <class Run>
Patience never_silent(const Run& run, double most_s = most_silence_s) {
  Patience patience;
  int tries = 0;
  do {
    patience = Patience();
    static_cast<void>(run(patience.job()));
    patience.ended();
  } while (++tries < 5 && patience.longest_silence_s() >= most_s);
  EXPECT_LT(patience.longest_silence_s(), most_s) << patience.silent_stage();
  std::cout << "  silent for at most " << 1e3 * patience.longest_silence_s() << " ms (" << patience.silent_stage()
            << ")\n";
  return patience;
}

/// The same of a run that makes what it is to make.
template <class Run>
Patience whole(const Run& run) {
  return never_silent([&run](const Job& job) {
    const auto made = run(job);
    EXPECT_TRUE(made.has_value()) << made.error().message;
    return made;
  });
}

/// Runs until `patience` says stop; where it does not, because the run is over before, nothing is asked.
/// \return seconds of CPU to the end.
template <class Run>
double expect_cancelled(Patience& patience, const Run& run, const std::string& where) {
  const auto result = run(patience.job());
  const double end_s = patience.ended();
  if (!patience.stopped()) return 0;
  EXPECT_FALSE(result.has_value()) << "goes on after " << where;
  if (!result) {
    EXPECT_EQ(result.error().code, ErrorCode::cancelled) << "after " << where << ": " << result.error().message;
  }
  EXPECT_EQ(patience.asked_again(), "") << "after " << where;
  EXPECT_LT(end_s, most_end_s) << "after " << where;
  EXPECT_LT(patience.ended_wall_s(), most_end_wall_s) << "after " << where;
  return end_s;
}

/// At every n-th of the reports that the whole run made, about `times` in all. \return the longest seconds of CPU to
/// the end.
template <class Run>
double expect_cancelled_at_a_spread(const Patience& whole, const Run& run, int times) {
  double worst_s = 0;
  for (int k = 1; k <= whole.reports(); k += 1 + whole.reports() / times) {
    Patience patience(k);
    worst_s = std::max(worst_s, expect_cancelled(patience, run, fmt::format("report {} of {}", k, whole.reports())));
    EXPECT_TRUE(patience.stopped() || k > whole.reports() / 2) << "never came to report " << k;
  }
  return worst_s;
}

/// At the first and the last report of each stage that is not among those `seen`. A stage in a child process reports as
/// time goes by, and may say less the second time.
template <class Run>
void expect_cancelled_in_stages(const Patience& whole, const Run& run, std::set<std::string>& seen) {
  for (const auto& [stage, count] : whole.reports_by_stage())
    if (seen.insert(stage).second)
      for (const int k : std::set<int>{1, count}) {
        Patience patience(k, stage);
        expect_cancelled(patience, run, fmt::format("report {} of {} of \"{}\"", k, count, stage));
        EXPECT_TRUE(patience.stopped() || k > 1) << "\"" << stage << "\" never came";
      }
}

}  // namespace aplomb::test
