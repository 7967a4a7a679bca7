#pragma once

#include <cstdint>
#include <string_view>
#include <utility>

#include "aplomb/core/job.h"

namespace aplomb {

/// A job's reports from loops too deep, or too fast, to report themselves: they ask at every step whether to go on, and
/// a report is made at the first and then each time that steps of about 20 ms were asked for, all at one place of the
/// job. Once the answer was no, it stays no and nobody is asked again: loops fall through, and the stage that
/// `stopped()` returns cancelled(), whatever the loops left.
class Pulse {
 public:
  Pulse() = default;  ///< nobody listens: it goes on
  Pulse(Job job, double fraction, std::string_view stage) : job_(std::move(job)), fraction_(fraction), stage_(stage) {}

  /// False: leave off. \param step_us  about how many microseconds the step takes
  bool goes_on(std::uint32_t step_us = 1) const {
    if (due_us_ > step_us) {
      due_us_ -= step_us;
    } else {
      due_us_ = every_us;
      stopped_ = stopped_ || !job_.report(fraction_, stage_);
    }
    return !stopped_;
  }
  bool stopped() const { return stopped_; }

 private:
  static constexpr std::uint32_t every_us = 20'000;

  Job job_;
  double fraction_ = 0;
  std::string_view stage_;
  mutable std::uint32_t due_us_ = 0;
  mutable bool stopped_ = false;
};

}  // namespace aplomb
