#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "aplomb/core/error.h"

namespace aplomb {

enum class Process { fdm, sla, powder, binder };
inline constexpr std::array<std::string_view, 4> process_names{"fdm", "sla", "powder", "binder"};  // in its order
std::optional<Process> process_named(std::string_view name);

/// Where a number becomes a finding; no number, no finding of that severity.
struct Limits {
  std::optional<double> info{}, warn{}, fail{};
};

/// One check, or one number that checks need, and its defaults.
struct CheckRule {
  std::string_view id;
  std::string_view unit;                          ///< "mm", "mm2", "deg", "MPa", "%", or "" for counts
  std::string_view what;                          ///< is measured: "least wall between a void and the outside"
  bool is_least = true;                           ///< a measure below its limit is wrong; else above it
  std::array<std::optional<Limits>, 4> limits{};  ///< by process; none: no check there
  bool is_check = true;                           ///< false: a number that a check uses, such as the diameter of a hole
};

/// Every check and number, with its defaults and, in rules.cpp, where they come from.
std::span<const CheckRule> check_rules();

/// What one run judges by: the defaults of a process and what the user changed.
class Rules {
 public:
  explicit Rules(Process process) : process_(process) {}

  Process process() const { return process_; }
  /// Nothing where the check is not made for this process.
  std::optional<Limits> limits(std::string_view id) const;
  /// A number that a check uses. \pre id is one of check_rules() and has a number for this process.
  double number(std::string_view id) const;

  /// Replaces the most severe limit of a check, or a number; what is between it and a good measure stays where it is,
  /// unless it is worse. \return invalid_option naming the ids there are, or the range.
  Result<void> set(std::string_view id, double value);
  /// \return invalid_option naming the ids there are.
  Result<void> waive(std::string_view id);
  bool is_waived(std::string_view id) const { return waived_.count(std::string(id)) > 0; }

  double layer_mm = 0.2;  ///< height of a layer, > 0

 private:
  Process process_;
  std::map<std::string, Limits, std::less<>> changed_;
  std::set<std::string> waived_;
};

}  // namespace aplomb
