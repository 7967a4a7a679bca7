#include "aplomb/core/isolated.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
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

TEST(RunIsolated, a_cancel_ends_the_child) {
  int reports = 0;
  const Job job([&](double, std::string_view) { return ++reports < 3; });
  EXPECT_EQ(run_isolated(endless, {}, job).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace aplomb
