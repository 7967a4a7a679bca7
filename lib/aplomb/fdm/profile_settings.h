#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace aplomb::detail {

struct Setting {
  std::string text;
  std::size_t line = 0;  ///< 0: not known
};
using Settings = std::map<std::string, Setting, std::less<>>;

/// The settings in "name = value" lines, which may be comments, or in a JSON object; the last of a name counts. \param
/// first_line  number of the text's first line; 0: not known.
Settings settings_of_profile(std::string_view text, std::size_t first_line = 1);

/// Settings by name, as numbers; the first that cannot be read is remembered. Expressions are never evaluated.
class SettingsReader {
 public:
  explicit SettingsReader(const Settings& settings) : settings_(settings) {}

  bool has(std::string_view name) const { return settings_.find(name) != settings_.end(); }
  std::string text(std::string_view name, std::string_view otherwise) const;
  /// "line 3: layer_height is '0,2'": as the file has it; nothing where it has no such setting.
  std::string shown(std::string_view name) const;
  /// Shares are of `whole`.
  double number(std::string_view name, double otherwise, double whole = 1);
  /// The first of a list with one for each tool.
  double by_tool(std::string_view name, double otherwise, double whole = 1);
  const std::string& problem() const { return problem_; }

 private:
  template <class Parse>
  double read(std::string_view name, double otherwise, const Parse& parse);

  const Settings& settings_;
  std::string problem_;
};

}  // namespace aplomb::detail
