#include "talk.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <span>

#include "aplomb/io/atomic_file.h"
#include "interrupt.h"
#include "run.h"

namespace aplomb::cli {
namespace {

int exit_code(const Error& error) {
  switch (error.code) {
    case ErrorCode::invalid_option:
      return Exit::usage;
    case ErrorCode::unusable_input:
    case ErrorCode::file_system:
      return Exit::bad_input;
    case ErrorCode::cancelled:
      return cancelled_exit;
    case ErrorCode::over_budget:
      return Exit::over_budget;
    default:
      return Exit::internal;
  }
}

}  // namespace

int report_error(const Error& error) {
  fmt::print(stderr, "aplomb: {}\n", error.message);
  return exit_code(error);
}

ProgressLine::ProgressLine(bool shown) : shown_(shown && isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

Job ProgressLine::job() {
  return Job([this](double fraction, std::string_view stage) {
    show(fraction, stage);
    return !interrupted();
  });
}

void ProgressLine::show(double fraction, std::string_view stage) {
  const auto now = std::chrono::steady_clock::now();
  if (!shown_ || now - last_ < std::chrono::milliseconds(50)) return;
  last_ = now;
  fmt::print(stderr, "\r\033[K{:3.0f} % {}", 100 * fraction, stage);
}

Result<void> write_text(const std::filesystem::path& path, const std::string& text) {
  return write_file_atomically(path, std::as_bytes(std::span(text)), remember_temp_file);
}

}  // namespace aplomb::cli
