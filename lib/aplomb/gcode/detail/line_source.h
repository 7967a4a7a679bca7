#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "aplomb/core/error.h"

namespace aplomb::detail {

/// The lines of a file of any size, in constant memory.
class LineSource {
 public:
  /// \return file_system where it cannot be opened.
  static Result<LineSource> open(const std::filesystem::path& path);

  LineSource(LineSource&& other) noexcept;
  LineSource& operator=(LineSource&& other) = delete;
  LineSource(const LineSource&) = delete;
  ~LineSource();

  /// The first bytes, at most 64 kB, behind the mark of UTF-8. \pre next() was not called.
  std::string_view head();
  /// The next line without its end; valid until the next call. Nothing at the end, or where reading failed.
  std::optional<std::string_view> next();

  /// Why the lines ended early: file_system, or unusable_input for a line that no slicer writes.
  const std::optional<Error>& error() const { return error_; }
  std::uint64_t line_number() const { return line_number_; }
  /// Of the lines that were handed out.
  std::uint64_t bytes_done() const { return bytes_read_ - (end_ - begin_); }
  std::uint64_t bytes() const { return bytes_; }
  /// Whether the last line had no end. \pre next() has returned nothing.
  bool ended_within_a_line() const { return ended_within_a_line_; }

  /// The last bytes of the file, at most so many; what next() returns does not change.
  Result<std::vector<char>> tail(std::size_t most_bytes) const;

 private:
  LineSource(int file, std::filesystem::path path, std::uint64_t bytes);
  bool refill();
  Error error_of(ErrorCode code, const std::string& what) const;

  int file_;
  std::filesystem::path path_;
  std::uint64_t bytes_, bytes_read_ = 0, line_number_ = 0;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what has not been handed out
  bool at_end_ = false, ended_within_a_line_ = false;
  std::optional<Error> error_;
};

}  // namespace aplomb::detail
