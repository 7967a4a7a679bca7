#include "interrupt.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <string>

namespace aplomb::cli {
namespace {

// A signal handler has no argument for what it needs: these are its state, and touched by async-signal-safe calls only.
std::atomic<bool> was_interrupted{false};
std::atomic<bool> has_temp_file{false};
std::array<char, 4096> temp_file{};
int code_at_interrupt = 1;
int code_over_time = 1;
std::atomic<bool> was_over_time{false};
timer_t deadline{};

void end_now(int) {
  remove_temp_file();
  if (was_over_time.load()) {
    constexpr char said[] = "aplomb: the time is over (--time)\n";
    [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, said, sizeof said - 1);
    _exit(code_over_time);
  }
  _exit(code_at_interrupt);
}

void note_interrupt(int signal_number) {
  if (was_interrupted.exchange(true)) end_now(signal_number);  // asked twice
  itimerspec in_150_ms{};
  in_150_ms.it_value.tv_nsec = 150'000'000;
  timer_settime(deadline, 0, &in_150_ms, nullptr);
}

void note_time(int signal_number) {
  if (was_interrupted.load()) return;
  was_over_time = true;
  note_interrupt(signal_number);
}

/// A timer that sends a signal.
timer_t timer_for(int signal_number) {
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = signal_number;
  timer_t timer{};
  timer_create(CLOCK_MONOTONIC, &event, &timer);
  return timer;
}

void handle(int signal_number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

void remove_temp_file() {
  if (has_temp_file.load()) unlink(temp_file.data());
}

void catch_interrupts(int exit_code) {
  code_at_interrupt = exit_code;
  deadline = timer_for(SIGALRM);
  handle(SIGALRM, end_now);
  handle(SIGINT, note_interrupt);
  handle(SIGTERM, note_interrupt);
}

void limit_time(double seconds, int exit_code) {
  code_over_time = exit_code;
  handle(SIGVTALRM, note_time);
  itimerspec after{};
  after.it_value.tv_sec = static_cast<time_t>(seconds);
  after.it_value.tv_nsec = static_cast<long>((seconds - std::floor(seconds)) * 1e9);
  timer_settime(timer_for(SIGVTALRM), 0, &after, nullptr);
}

bool is_over_time() { return was_over_time.load(); }

bool interrupted() { return was_interrupted.load(); }

void remember_temp_file(const std::filesystem::path& path) {
  has_temp_file = false;
  const std::string name = path.string();
  if (name.empty() || name.size() >= temp_file.size()) return;
  std::memcpy(temp_file.data(), name.c_str(), name.size() + 1);
  has_temp_file = true;
}

}  // namespace aplomb::cli
