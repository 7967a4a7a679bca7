#include "aplomb/gcode/detail/line_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace aplomb::detail {
namespace {

// Starts small, as small files need no more; grows to hold a line.
constexpr std::size_t least_buffer_bytes = 1 << 12, usual_buffer_bytes = 1 << 16, most_buffer_bytes = 1 << 20;
constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";

ssize_t read_some(int file, char* to, std::size_t bytes) {
  ssize_t count = 0;
  do count = read(file, to, bytes);
  while (count < 0 && errno == EINTR);
  return count;
}

std::string reason() { return std::error_code(errno, std::generic_category()).message(); }

}  // namespace

Result<LineSource> LineSource::open(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return fail(ErrorCode::file_system, fmt::format("{}: {}; check its name", path.string(), reason()));
  struct stat about {};
  if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) {
    close(file);
    return fail(ErrorCode::file_system, path.string() + ": this is no file; give a G-code file");
  }
  return LineSource(file, path, static_cast<std::uint64_t>(about.st_size));
}

LineSource::LineSource(int file, std::filesystem::path path, std::uint64_t bytes)
    : file_(file),
      path_(std::move(path)),
      bytes_(bytes),
      buffer_(bytes < least_buffer_bytes ? least_buffer_bytes : usual_buffer_bytes) {}

LineSource::LineSource(LineSource&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      path_(std::move(other.path_)),
      bytes_(other.bytes_),
      bytes_read_(other.bytes_read_),
      line_number_(other.line_number_),
      buffer_(std::move(other.buffer_)),
      begin_(other.begin_),
      end_(other.end_),
      at_end_(other.at_end_),
      ended_within_a_line_(other.ended_within_a_line_),
      error_(std::move(other.error_)) {}

LineSource::~LineSource() {
  if (file_ >= 0) close(file_);
}

Error LineSource::error_of(ErrorCode code, const std::string& what) const {
  return {code, fmt::format("{}: {}", path_.string(), what)};
}

bool LineSource::refill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= std::exchange(begin_, 0);
  if (end_ == most_buffer_bytes) {
    error_ = error_of(ErrorCode::unusable_input,
                      fmt::format("line {}: it is longer than {} bytes, as none of G-code is; give the file that the "
                                  "slicer exported",
                                  line_number_ + 1, end_));
    return false;
  }
  if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
  const ssize_t count = read_some(file_, buffer_.data() + end_, buffer_.size() - end_);
  if (count < 0) error_ = error_of(ErrorCode::file_system, reason() + "; copy the file anew");
  if (count <= 0) at_end_ = true;
  else end_ += static_cast<std::size_t>(count), bytes_read_ += static_cast<std::uint64_t>(count);
  return count > 0;
}

std::string_view LineSource::head() {
  if (end_ == 0) refill();
  if (begin_ == 0 && std::string_view(buffer_.data(), end_).starts_with(utf8_mark)) begin_ = utf8_mark.size();
  return {buffer_.data() + begin_, end_ - begin_};
}

std::optional<std::string_view> LineSource::next() {
  std::size_t searched = 0;
  if (line_number_ == 0) head();  // skips the mark
  while (!error_) {
    const char* start = buffer_.data() + begin_;
    const auto* end = static_cast<const char*>(std::memchr(start + searched, '\n', end_ - begin_ - searched));
    if (!end && !at_end_) {
      searched = end_ - begin_;
      refill();
      continue;
    }
    ended_within_a_line_ = !end && begin_ < end_;
    if (!end && begin_ == end_) return std::nullopt;
    std::string_view line(start, end ? static_cast<std::size_t>(end - start) : end_ - begin_);
    begin_ += line.size() + (end ? 1 : 0);
    ++line_number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  return std::nullopt;
}

Result<std::vector<char>> LineSource::tail(std::size_t most_bytes) const {
  std::vector<char> last(static_cast<std::size_t>(std::min<std::uint64_t>(most_bytes, bytes_)));
  std::size_t done = 0;
  while (done < last.size()) {
    const auto from = static_cast<off_t>(bytes_ - last.size() + done);
    const ssize_t count = pread(file_, last.data() + done, last.size() - done, from);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return tl::unexpected(error_of(ErrorCode::file_system, reason() + "; copy the file anew"));
    if (count == 0) break;  // it became shorter
    done += static_cast<std::size_t>(count);
  }
  last.resize(done);
  return last;
}

}  // namespace aplomb::detail
