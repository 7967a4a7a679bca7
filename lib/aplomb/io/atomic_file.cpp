#include "aplomb/io/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <ctime>
#include <string>
#include <string_view>
#include <system_error>

#include "aplomb/core/printable.h"

namespace aplomb {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> cannot_write(const fs::path& target, const std::string& reason) {
  return fail(ErrorCode::file_system, "cannot write " + printable(target.string(), 4096) + ": " + reason);
}

std::string reason_of(int error_number) { return std::generic_category().message(error_number); }

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

bool write_all(int fd, std::span<const std::byte> bytes) {
  constexpr std::size_t kChunk = std::size_t{1} << 24;
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), std::min(bytes.size(), kChunk));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

/// What a chain of symbolic links points to in the end, whether that exists or not.
Result<fs::path> without_links(const fs::path& target) {
  fs::path path = target;
  for (int link = 0; link < 40; ++link) {
    std::error_code error;
    if (!fs::is_symlink(path, error)) return path;
    const fs::path next = fs::read_symlink(path, error);
    if (error) return cannot_write(target, error.message());
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return cannot_write(target, "its symbolic links run in a circle");
}

/// Removes the temporary file unless it was renamed, and tells the listener either way.
class TempFile {
 public:
  TempFile(fs::path path, const TempFileListener& listener) : path_(std::move(path)), listener_(listener) {
    if (listener_) listener_(path_);
  }
  ~TempFile() {
    if (made_) ::unlink(path_.c_str());
    if (listener_) listener_({});
  }
  TempFile(const TempFile&) = delete;
  TempFile& operator=(const TempFile&) = delete;
  const fs::path& path() const { return path_; }
  void set_made(bool made) { made_ = made; }

 private:
  fs::path path_;
  const TempFileListener& listener_;
  bool made_ = false;
};

/// A short name of its own in the target's folder, so that a target with the longest possible name works too.
fs::path temp_path_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  const std::string name =
      ".aplomb-" + std::to_string(::getpid()) + "-" + std::to_string(now) + "-" + std::to_string(counter++) + ".tmp";
  return fs::absolute(target).parent_path() / name;
}

/// The process that made a temporary file of ours; 0 for any other name.
pid_t maker_of(const std::string& name) {
  constexpr std::string_view prefix = ".aplomb-";
  if (!name.starts_with(prefix) || !name.ends_with(".tmp")) return 0;
  int id = 0;
  const char *from = name.data() + prefix.size(), *end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(from, end, id);
  return error == std::errc() && stop != end && *stop == '-' && id > 0 ? id : 0;
}

/// Removes what killed runs left in a folder: no such process runs here, nor wrote to it elsewhere within the hour.
void clear_left_behind(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const pid_t maker = maker_of(entry->path().filename().string());
    if (maker == 0 || ::kill(maker, 0) == 0 || errno != ESRCH) continue;
    struct stat status {};
    if (::lstat(entry->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
    if (::time(nullptr) - status.st_mtime > 3600) ::unlink(entry->path().c_str());
  }
}

Result<void> write_straight(const fs::path& target, std::span<const std::byte> bytes) {
  const Descriptor file(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0 || !write_all(file.get(), bytes)) return cannot_write(target, reason_of(errno));
  return {};
}

/// So that the new name survives a power cut. A folder that cannot be opened for this is no failure.
void sync_folder(const fs::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() >= 0) ::fsync(descriptor.get());
}

Result<void> write_and_rename(const fs::path& target, const struct stat* existing, std::span<const std::byte> bytes,
                              const TempFileListener& listener) {
  clear_left_behind(fs::absolute(target).parent_path());
  TempFile temp(temp_path_beside(target), listener);
  Descriptor file(::open(temp.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (file.get() < 0) return cannot_write(target, "no file can be made in its folder: " + reason_of(errno));
  temp.set_made(true);
  if (existing && ::fchmod(file.get(), existing->st_mode & 0777) != 0) return cannot_write(target, reason_of(errno));
  if (!write_all(file.get(), bytes) || ::fsync(file.get()) != 0 || !file.close())
    return cannot_write(target, reason_of(errno));
  if (::rename(temp.path().c_str(), target.c_str()) != 0) return cannot_write(target, reason_of(errno));
  temp.set_made(false);
  sync_folder(temp.path().parent_path());
  return {};
}

}  // namespace

Result<void> write_file_atomically(const fs::path& target, std::span<const std::byte> bytes,
                                   const TempFileListener& on_temp_file) {
  if (target == "-") {
    if (!write_all(STDOUT_FILENO, bytes)) return cannot_write("standard output", reason_of(errno));
    return {};
  }
  if (target.empty()) return cannot_write("\"\"", "the name is empty");
  const Result<fs::path> path = without_links(target);
  if (!path) return tl::unexpected<Error>(path.error());

  struct stat status {};
  const bool exists = ::stat(path->c_str(), &status) == 0;
  if (!exists && errno != ENOENT) return cannot_write(target, reason_of(errno));
  if (exists && S_ISDIR(status.st_mode)) return cannot_write(target, "it is a directory; name a file in it");
  if (exists && ::faccessat(AT_FDCWD, path->c_str(), W_OK, AT_EACCESS) != 0)
    return cannot_write(target, reason_of(errno));
  if (exists && !S_ISREG(status.st_mode)) return write_straight(*path, bytes);
  const fs::path folder = fs::absolute(*path).parent_path();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    return cannot_write(target, "there is no folder " + printable(folder.string(), 4096) + "; make it first");
  return write_and_rename(*path, exists ? &status : nullptr, bytes, on_temp_file);
}

}  // namespace aplomb
