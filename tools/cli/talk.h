#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/ending.h"

// What every command says, and where.

namespace aplomb::cli {

inline int exit_code(Ending ending) { return static_cast<int>(ending); }

/// Of a message, in bytes: the longest path and a sentence. What names a file may hold anything but a zero, so that
/// printable() has the last word on what goes to the terminal.
inline constexpr std::size_t longest_message = 6000;

/// Says it on standard error. \return the exit code.
int report_error(const Error& error);

/// A line that is written over, on a terminal, and wiped at the end; or a line of JSON each time, for programs.
class ProgressLine {
 public:
  ProgressLine(bool shown, bool is_json);
  ~ProgressLine();
  /// Cancels when the program was interrupted. \pre the line outlives it.
  Job job();

 private:
  void show(double fraction, std::string_view stage);

  bool is_json_;
  bool shown_;
  std::chrono::steady_clock::time_point last_{};
};

Result<void> write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace aplomb::cli
