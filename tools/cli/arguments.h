#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aplomb/pipeline.h"

namespace aplomb::cli {

enum class Command { stand, check };

/// What the command line asked for.
struct Arguments {
  Command command = Command::check;
  std::filesystem::path model;
  std::filesystem::path output;
  std::filesystem::path report;
  std::filesystem::path dump;
  InputOptions input;
  StandOptions stand;
  std::vector<std::string> contacts;  ///< "X,Y,Z[,R]", resolved when the model's size is known
  int threads = 0;
  bool quiet = false;
  std::vector<std::pair<std::string, std::string>> given;  ///< flags as they were given, for the report
};

/// Arguments, or the exit code after help, version or a usage error was printed.
struct Parsed {
  std::optional<Arguments> arguments;
  int exit_code = 0;
};

Parsed parse_arguments(int argc, char** argv);

/// The contacts as balls; a radius that was left out is 5 % of the model's height.
Result<std::vector<Contact>> contacts_of(const std::vector<std::string>& texts, double height_mm);

}  // namespace aplomb::cli
