#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aplomb/gcode/printed_plate.h"
#include "aplomb/gcode/verify_print.h"
#include "aplomb/job/job_file.h"

namespace aplomb::cli {

enum class Command {
  check,
  stand,
  hang,
  poses,     ///< list the ways it can rest
  run,       ///< a job file
  validate,  ///< judge whether it prints
  verify,    ///< measure what G-code prints
};

/// What `aplomb verify` was asked for.
struct VerifyArguments {
  std::filesystem::path program, expect, report;
  GcodeOptions gcode;
  VerifyOptions options;
};

/// What the command line asked for.
struct Arguments {
  Command command = Command::check;
  JobFile job;  ///< without an output the poses are only checked
  VerifyArguments verify;
  std::filesystem::path save_job;  ///< where to write `job`; empty: nowhere
  std::filesystem::path job_file;  ///< where `job` was read; empty: the flags say it
  std::optional<double> time_s;    ///< after which it ends, whatever it is at; none: the job's
  bool quiet = false;
  bool is_progress_json = false;                           ///< told as lines of JSON, also where there is no terminal
  std::vector<std::pair<std::string, std::string>> given;  ///< flags as they were given, for the report
};

/// Arguments, or the exit code after help, version or a usage error was printed.
struct Parsed {
  std::optional<Arguments> arguments;
  int exit_code = 0;
};

Parsed parse_arguments(int argc, char** argv);

}  // namespace aplomb::cli
