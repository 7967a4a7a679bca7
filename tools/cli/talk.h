#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"

// What every command says, and where.

namespace aplomb::cli {

enum Exit { stands = 0, usage = 1, bad_input = 2, cannot_stand = 3, over_budget = 5, does_not_print = 6, internal = 7 };

/// Says it on standard error. \return the exit code.
int report_error(const Error& error);

/// A line that is written over, on a terminal; nothing elsewhere. Its end also wipes it.
class ProgressLine {
 public:
  explicit ProgressLine(bool shown);
  ~ProgressLine();
  /// Cancels when the program was interrupted. \pre the line outlives it.
  Job job();

 private:
  void show(double fraction, std::string_view stage);

  bool shown_;
  std::chrono::steady_clock::time_point last_{};
};

Result<void> write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace aplomb::cli
