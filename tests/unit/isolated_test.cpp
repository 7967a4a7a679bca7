#include "aplomb/core/isolated.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace aplomb {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string endless() {
  for (;;) usleep(1000);
}

TEST(RunIsolated, returns_the_bytes_the_work_made) {
  const std::string bytes(1'000'000, 'x');
  EXPECT_EQ(run_isolated([&] { return bytes; }, {}).value(), bytes);
  EXPECT_EQ(run_isolated([] { return std::string(); }, {}).value(), "");
}

TEST(RunIsolated, a_crash_is_an_error_and_the_parent_lives) {
  const auto result = run_isolated(
      []() -> std::string {
        std::raise(SIGSEGV);
        return "no";
      },
      {});
  EXPECT_EQ(result.error().code, ErrorCode::third_party);
  EXPECT_EQ(run_isolated([]() -> std::string { std::abort(); }, {}).error().code, ErrorCode::third_party);
  EXPECT_EQ(run_isolated([]() -> std::string { _exit(3); }, {}).error().code, ErrorCode::third_party);
}

TEST(RunIsolated, an_exception_comes_back_in_words) {
  const auto result = run_isolated([]() -> std::string { throw std::runtime_error("hole 7"); }, {});
  EXPECT_EQ(result.error().code, ErrorCode::third_party);
  EXPECT_EQ(result.error().message, "hole 7");
}

TEST(RunIsolated, work_without_end_is_stopped_at_its_limit) {
  const auto start = Clock::now();
  EXPECT_EQ(run_isolated(endless, {.seconds = 0.2}).error().code, ErrorCode::over_budget);
  EXPECT_LT(seconds_since(start), 5);
}

TEST(RunIsolated, memory_beyond_the_limit_is_refused) {
  const auto eat = []() -> std::string { return std::to_string(std::vector<char>(std::size_t{1} << 31, 'x').back()); };
  EXPECT_EQ(run_isolated(eat, {.memory_mb = 256}).error().code, ErrorCode::over_budget);
}

TEST(RunIsolated, a_child_killed_from_outside_is_an_error_that_names_the_signal) {
  for (const int signal : {SIGKILL, SIGTERM}) {
    const auto result = run_isolated(
        [signal]() -> std::string {
          kill(getpid(), signal);
          return endless();
        },
        {});
    EXPECT_EQ(result.error().code, ErrorCode::third_party);
    EXPECT_NE(result.error().message.find(strsignal(signal)), std::string::npos) << result.error().message;
  }
}

TEST(RunIsolated, a_stack_that_overflows_is_an_error) {
  struct Deep {
    static int fall(volatile int* above) {
      volatile int here[1024];
      here[0] = *above;
      if (here[0] != 0) return 0;  // never
      return fall(here) + here[0];
    }
  };
  volatile int start = 0;
  const auto result = run_isolated([&start] { return std::to_string(Deep::fall(&start)); }, {.memory_mb = 256});
  EXPECT_EQ(result.error().code, ErrorCode::third_party);
}

TEST(RunIsolated, many_children_leave_neither_processes_nor_open_files_behind) {
  const auto open_files = [] {
    int count = 0;
    for (int file = 0; file < 256; ++file) count += fcntl(file, F_GETFD) != -1;
    return count;
  };
  const int before = open_files();
  for (int i = 0; i < 50; ++i)
    run_isolated([i]() -> std::string { return i % 2 ? std::string("x") : (std::abort(), ""); }, {});
  EXPECT_EQ(open_files(), before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child is left, alive or dead
  EXPECT_EQ(errno, ECHILD);
}

TEST(RunIsolated, a_cancel_ends_the_child) {
  int reports = 0;
  const Job job([&](double, std::string_view) { return ++reports < 3; });
  EXPECT_EQ(run_isolated(endless, {}, job).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace aplomb
