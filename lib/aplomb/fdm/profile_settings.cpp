#include "aplomb/fdm/profile_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "aplomb/core/printable.h"

namespace aplomb::detail {
namespace {

constexpr std::string_view blanks = " \t\r;";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// "name = value" lines; a comment's semicolon is left out.
Settings settings_in_lines(std::string_view text, std::size_t first_line) {
  Settings settings;
  for (std::size_t number = first_line; !text.empty(); number += number > 0 ? 1 : 0) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t equals = line.find('=');
    if (equals == line.npos || equals > 80) continue;
    settings.insert_or_assign(std::string(trimmed(line.substr(0, equals))),
                              Setting{std::string(trimmed(line.substr(equals + 1))), number});
  }
  return settings;
}

/// Of an object's own members; JSON tells no lines.
Settings settings_in_json(std::string_view text) {
  Settings settings;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return settings;
  for (const auto& [name, value] : json.items())
    if (value.is_primitive()) settings[name] = {value.is_string() ? value.get<std::string>() : value.dump(), 0};
  return settings;
}

/// All of the text is one number, or a share of `whole`: "0.2" or "75%".
std::optional<double> whole_number(std::string_view text, double whole) {
  double parsed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (error != std::errc{} || !std::isfinite(parsed) || (!rest.empty() && rest != "%")) return std::nullopt;
  return rest.empty() ? parsed : parsed / 100 * whole;
}

/// By tool, "0.4,0.4": the first, if all are numbers. "1,05" is none, but a decimal comma.
std::optional<double> first_of_list(std::string_view text, double whole) {
  std::optional<double> first;
  while (true) {
    const std::string_view entry = text.substr(0, text.find_first_of(",;"));
    const bool is_padded = entry.size() > 1 && entry[0] == '0' && entry[1] >= '0' && entry[1] <= '9';
    const auto number = is_padded ? std::nullopt : whole_number(trimmed(entry), whole);
    if (!number) return std::nullopt;
    if (!first) first = number;
    if (entry.size() == text.size()) return first;
    text.remove_prefix(entry.size() + 1);
  }
}

}  // namespace

Settings settings_of_profile(std::string_view text, std::size_t first_line) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '{' ? settings_in_json(text) : settings_in_lines(text, first_line);
}

std::string SettingsReader::text(std::string_view name, std::string_view otherwise) const {
  const auto found = settings_.find(name);
  return found == settings_.end() ? std::string(otherwise) : found->second.text;
}

std::string SettingsReader::shown(std::string_view name) const {
  const auto found = settings_.find(name);
  if (found == settings_.end()) return {};
  const std::string told = fmt::format("{} is '{}'", name, printable(found->second.text));
  return found->second.line == 0 ? told : fmt::format("line {}: {}", found->second.line, told);
}

double SettingsReader::number(std::string_view name, double otherwise, double whole) {
  return read(name, otherwise, [whole](std::string_view text) { return whole_number(text, whole); });
}

double SettingsReader::by_tool(std::string_view name, double otherwise, double whole) {
  return read(name, otherwise, [whole](std::string_view text) { return first_of_list(text, whole); });
}

template <class Parse>
double SettingsReader::read(std::string_view name, double otherwise, const Parse& parse) {
  const auto found = settings_.find(name);
  if (found == settings_.end()) return otherwise;
  const std::string& value = found->second.text;
  if (value == "true" || value == "True") return 1;
  if (value == "false" || value == "False") return 0;
  if (const std::optional<double> number = parse(value)) return *number;
  if (problem_.empty())
    problem_ = shown(name) + (value.starts_with('=') ? ", an expression, which is not evaluated; give its value"
                                                     : ", which is no number; write it as 0.2 or 15%");
  return otherwise;
}

}  // namespace aplomb::detail
