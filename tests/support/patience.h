#pragma once

#include <limits>
#include <string>

#include "aplomb/core/job.h"

namespace aplomb::test {

/// Seconds of CPU that the calling thread took so far: what others do on the machine does not count.
double thread_cpu_s();

/// A listener that stops a run at its k-th report, and knows how long the run was silent and how long it took to end.
class Patience {
 public:
  explicit Patience(int stop_at = std::numeric_limits<int>::max()) : stop_at_(stop_at) {}
  Job job();
  /// To be told that the run is over. \return CPU seconds since the last report.
  double ended();

  int reports() const { return reports_; }
  /// The longest time between two reports, and which those were.
  double longest_silence_s() const { return longest_s_; }
  const std::string& silent_stage() const { return silent_; }

 private:
  void note(double fraction, std::string_view stage);

  int stop_at_;
  int reports_ = 0;
  double last_s_ = thread_cpu_s();
  double longest_s_ = 0;
  std::string last_ = "the start", silent_;
};

}  // namespace aplomb::test
