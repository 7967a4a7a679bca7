#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aplomb/core/vec.h"

namespace aplomb::cli {

/// A unit by its name and what one of it is in the base unit: {"mm", 1}, {"cm", 10}.
struct Unit {
  const char* name;
  double factor;
};

/// "2mm", "0.5in" or "2" (the base unit) as a number in the base unit; nothing where the text is no such thing.
std::optional<double> parse_quantity(const std::string& text, const std::vector<Unit>& units);

inline const std::vector<Unit> lengths{{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"um", 1e-3}};
inline const std::vector<Unit> angles{{"deg", 0.017453292519943295}, {"rad", 1}};
inline const std::vector<Unit> percentages{{"%", 1}};
inline const std::vector<Unit> durations{{"s", 1}, {"ms", 1e-3}, {"min", 60}, {"h", 3600}};
inline const std::vector<Unit> memories{{"MB", 1e6}, {"GB", 1e9}, {"KB", 1e3}, {"B", 1}};

/// "1,2.5,-3" as numbers; nothing where it is no list of numbers.
std::optional<std::vector<double>> parse_numbers(const std::string& text);

}  // namespace aplomb::cli
