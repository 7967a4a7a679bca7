#include "talk.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <span>

#include "aplomb/core/printable.h"
#include "aplomb/io/atomic_file.h"
#include "interrupt.h"
#include "run.h"

namespace aplomb::cli {

int report_error(const Error& error) {
  if (error.code == ErrorCode::cancelled && is_over_time()) {
    fmt::print(stderr, "aplomb: the time is over (--time)\n");
    return exit_code(Ending::over_budget);
  }
  fmt::print(stderr, "aplomb: {}\n", printable(error.message, longest_message));
  return exit_code(ending_of(error));
}

ProgressLine::ProgressLine(bool shown, bool is_json)
    : is_json_(is_json), shown_(is_json || (shown && isatty(STDERR_FILENO) == 1)) {}

ProgressLine::~ProgressLine() {
  if (shown_ && !is_json_) fmt::print(stderr, "\r\033[K");
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
  if (is_json_) fmt::print(stderr, "{{\"progress\": {:.3f}, \"stage\": \"{}\"}}\n", fraction, stage);
  else fmt::print(stderr, "\r\033[K{:3.0f} % {}", 100 * fraction, stage);
}

Result<void> write_text(const std::filesystem::path& path, const std::string& text) {
  return write_file_atomically(path, std::as_bytes(std::span(text)), remember_temp_file);
}

}  // namespace aplomb::cli
