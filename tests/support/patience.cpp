#include "support/patience.h"

#include <fmt/format.h>

#include <ctime>

namespace aplomb::test {

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Job Patience::job() {
  return Job([this](double fraction, std::string_view stage) {
    note(fraction, stage);
    return ++reports_ < stop_at_;
  });
}

double Patience::ended() {
  const double since_s = thread_cpu_s() - last_s_;
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
}

}  // namespace aplomb::test
