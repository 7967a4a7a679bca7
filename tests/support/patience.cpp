#include "support/patience.h"

#include <fmt/format.h>

#include <chrono>
#include <ctime>

namespace aplomb::test {

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

Job Patience::job() {
  return Job([this](double fraction, std::string_view stage) {
    note(fraction, stage);
    if (stopped_) asked_again_ = last_;
    ++reports_;
    const int of_stage = ++by_stage_[std::string(stage)];
    const bool is_time = stage_.empty() ? reports_ >= stop_at_ : stage == stage_ && of_stage >= stop_at_;
    stopped_ = stopped_ || is_time;
    return !stopped_;
  });
}

double Patience::ended() {
  const double since_s = thread_cpu_s() - last_s_;
  ended_wall_s_ = wall_s() - last_wall_s_;
  note(1, "the end");
  return since_s;
}

void Patience::note(double fraction, std::string_view stage) {
  const double now_s = thread_cpu_s();
  std::string now = fmt::format("{} {:.3f}", stage, fraction);
  if (now_s - last_s_ > longest_s_) {
    longest_s_ = now_s - last_s_;
    silent_ = fmt::format("{} .. {}", last_, now);
  }
  last_ = std::move(now);
  last_s_ = now_s;
  last_wall_s_ = wall_s();
}

}  // namespace aplomb::test
