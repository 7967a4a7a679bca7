#pragma once

#include <filesystem>

namespace aplomb::studio {

/// A folder that only this user sees, removed with all it holds at the end. One that a killed server has left is
/// removed by the next.
class PrivateFolder {
 public:
  PrivateFolder();  ///< Throws std::filesystem::filesystem_error where there is no place for it.
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;  // held for as long as this process lives
};

}  // namespace aplomb::studio
