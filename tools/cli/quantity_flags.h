#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "quantities.h"

namespace aplomb::cli {

/// Binds a flag with a unit to a field (a number, or an optional one); CLI11 prints what is thrown.
template <class Field>
CLI::Option* add_quantity(CLI::App* app, const std::string& flag, Field& field, const std::vector<Unit>& units,
                          const std::string& help) {
  return app->add_option_function<std::string>(
      flag,
      [&field, &units, flag](const std::string& text) {
        const auto value = parse_quantity(text, units);
        if (!value)
          throw CLI::ValidationError(
              flag, fmt::format("'{}' is no number with a unit such as 10{}", text, units.front().name));
        if constexpr (std::is_integral_v<Field>) field = static_cast<Field>(*value);
        else field = *value;
      },
      help);
}

/// Binds a flag to one of the names; `choose` is told which.
template <class Choose>
CLI::Option* add_choice(CLI::App* app, const std::string& flag, const std::vector<std::string>& names,
                        const Choose& choose, const std::string& help) {
  return app->add_option_function<std::string>(flag, choose, help)->check(CLI::IsMember(names));
}

/// "X,Y,Z" and whatever else is allowed: throws unless there are `least` to `most` numbers.
inline std::vector<double> numbers_of(const std::string& flag, const std::string& text, std::size_t least,
                                      std::size_t most, const std::string& form) {
  const auto numbers = parse_numbers(text);
  if (!numbers || numbers->size() < least || numbers->size() > most)
    throw CLI::ValidationError(flag, "'" + text + "' is not " + form);
  return *numbers;
}

}  // namespace aplomb::cli
