#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace aplomb {

/// Seconds by stage, in the order in which the stages first ended.
using StageSeconds = std::vector<std::pair<std::string, double>>;

/// Tells how long each stage of a run took; a stage that comes again is summed.
class StageClock {
 public:
  explicit StageClock(StageSeconds& seconds) : seconds_(seconds) {}

  /// What passed since the last lap, or since the clock was made, was this stage's.
  void lap(std::string_view stage) {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    const auto known = std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& s) { return s.first == stage; });
    if (known == seconds_.end()) seconds_.emplace_back(stage, passed);
    else known->second += passed;
  }

 private:
  StageSeconds& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace aplomb
