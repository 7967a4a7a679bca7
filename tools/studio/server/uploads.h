#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "aplomb/core/error.h"

namespace aplomb::studio {

/// The last part of a name that came with an upload, without what is no text, of at most 100 bytes; its extension
/// stays. Never empty, "-" or a way to another folder.
std::string safe_name(std::string_view name);

/// A file that the page sent, alone in a folder of its own: a model or a profile.
struct Upload {
  int id = 0;        ///< from 1 on
  std::string name;  ///< the file's, in `folder`
  std::filesystem::path folder;

  std::filesystem::path file() const { return folder / name; }
  std::string stem() const { return std::filesystem::path(name).stem().string(); }
};

/// The files of a kind that were sent, of which the last few that were used are kept.
class Uploads {
 public:
  /// \param kind the beginning of the names of their folders in `folder`.
  /// \param most_bytes that are kept in all, besides the last file.
  Uploads(std::filesystem::path folder, std::string kind, std::uintmax_t most_bytes)
      : folder_(std::move(folder)), kind_(std::move(kind)), most_bytes_(most_bytes) {}

  /// A place for a new one, whose file is yet to be written; not found until add(). \return file_system.
  Result<Upload> begin(std::string_view name);
  /// Gives up a place that was not added.
  static void drop(const Upload& upload);
  void add(const Upload& upload);
  std::optional<Upload> find(int id);

 private:
  std::filesystem::path folder_;
  std::string kind_;
  std::uintmax_t most_bytes_;
  std::mutex mutex_;
  int last_id_ = 0;
  std::deque<Upload> kept_;
};

}  // namespace aplomb::studio
