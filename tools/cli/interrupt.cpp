#include "interrupt.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <string>

namespace aplomb::cli {
namespace {

// A signal handler has no argument for what it needs: these are its state, and touched by async-signal-safe calls only.
std::atomic<bool> was_interrupted{false};
std::atomic<bool> has_temp_file{false};
std::array<char, 4096> temp_file{};
int code_at_interrupt = 1;
timer_t deadline{};

void end_now(int) {
  if (has_temp_file.load()) unlink(temp_file.data());
  _exit(code_at_interrupt);
}

void note_interrupt(int signal_number) {
  if (was_interrupted.exchange(true)) end_now(signal_number);  // asked twice
  itimerspec in_150_ms{};
  in_150_ms.it_value.tv_nsec = 150'000'000;
  timer_settime(deadline, 0, &in_150_ms, nullptr);
}

void handle(int signal_number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

void catch_interrupts(int exit_code) {
  code_at_interrupt = exit_code;
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  timer_create(CLOCK_MONOTONIC, &event, &deadline);
  handle(SIGALRM, end_now);
  handle(SIGINT, note_interrupt);
  handle(SIGTERM, note_interrupt);
}

bool interrupted() { return was_interrupted.load(); }

void remember_temp_file(const std::filesystem::path& path) {
  has_temp_file = false;
  const std::string name = path.string();
  if (name.empty() || name.size() >= temp_file.size()) return;
  std::memcpy(temp_file.data(), name.c_str(), name.size() + 1);
  has_temp_file = true;
}

}  // namespace aplomb::cli
