#include "server/private_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace aplomb::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "aplomb-studio-";
constexpr const char* lock_name = ".held";

/// A file that is locked from the moment at which it has its name; -1: it cannot be.
int held_file(const fs::path& folder) {
  const fs::path unnamed = folder / ".new";
  const int file = open(unnamed.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0) rename(unnamed.c_str(), (folder / lock_name).c_str());
  return file;
}

bool is_own_folder(const fs::path& path) {
  struct stat is {};
  return lstat(path.c_str(), &is) == 0 && S_ISDIR(is.st_mode) && is.st_uid == geteuid();
}

/// What servers left that were killed: nobody holds their folders.
void remove_left_behind(const fs::path& parent) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, ignored)) {
    const fs::path& folder = entry.path();
    if (!folder.filename().string().starts_with(prefix) || !is_own_folder(folder)) continue;
    const int file = open((folder / lock_name).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) continue;
    if (flock(file, LOCK_EX | LOCK_NB) == 0) fs::remove_all(folder, ignored);
    close(file);
  }
}

}  // namespace

PrivateFolder::PrivateFolder() {
  const fs::path parent = fs::temp_directory_path();
  remove_left_behind(parent);
  std::string name = (parent / prefix).string() + "XXXXXX";  // as mkdtemp() wants it
  if (!mkdtemp(name.data()))                                 // 0700
    throw fs::filesystem_error("no folder for models", name, std::error_code(errno, std::generic_category()));
  path_ = name;
  lock_ = held_file(path_);
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (lock_ >= 0) close(lock_);
}

}  // namespace aplomb::studio
