#pragma once

#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "aplomb/core/job.h"

namespace aplomb::test {

/// Seconds of CPU that the calling thread took so far: what others do on the machine does not count.
double thread_cpu_s();

/// Seconds by the clock, during which threads and child processes work, too.
double wall_s();

/// A listener that stops a run at its k-th report, or the k-th of one stage, and knows how long the run was silent and
/// how long it took to end.
class Patience {
 public:
  explicit Patience(int stop_at = std::numeric_limits<int>::max(), std::string stage = {})
      : stop_at_(stop_at), stage_(std::move(stage)) {}
  Job job();
  /// To be told that the run is over. \return CPU seconds since the last report.
  double ended();
  /// What the clock says of that.
  double ended_wall_s() const { return ended_wall_s_; }

  bool stopped() const { return stopped_; }
  /// The report that came after that; none: "".
  const std::string& asked_again() const { return asked_again_; }
  int reports() const { return reports_; }
  /// How many of them each stage made.
  const std::map<std::string, int>& reports_by_stage() const { return by_stage_; }
  /// The longest time between two reports, and which those were.
  double longest_silence_s() const { return longest_s_; }
  const std::string& silent_stage() const { return silent_; }

 private:
  void note(double fraction, std::string_view stage);

  int stop_at_;
  std::string stage_;
  bool stopped_ = false;
  std::string asked_again_;
  int reports_ = 0;
  std::map<std::string, int> by_stage_;
  double last_s_ = thread_cpu_s(), last_wall_s_ = wall_s(), ended_wall_s_ = 0;
  double longest_s_ = 0;
  std::string last_ = "the start", silent_;
};

}  // namespace aplomb::test
