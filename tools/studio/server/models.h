#pragma once

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

/// A model that is worked on, alone in a folder of its own.
struct Model {
  int id = 0;
  std::string name;  ///< its file's, in `folder`
  std::filesystem::path folder;
  std::string profile{};  ///< the name of the profile that came with it, in the same folder; empty: none

  std::filesystem::path file() const { return folder / name; }
  std::string stem() const { return std::filesystem::path(name).stem().string(); }
};

/// The models that were given, of which the last few that were used are kept.
class Models {
 public:
  explicit Models(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// A place for a new one, whose file is yet to be written; not found until add(). \return file_system.
  Result<Model> begin(std::string_view name);
  void add(const Model& model);
  std::optional<Model> find(int id);

 private:
  std::filesystem::path folder_;
  std::mutex mutex_;
  int last_id_ = 0;
  std::deque<Model> kept_;
};

}  // namespace aplomb::studio
