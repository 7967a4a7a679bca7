#include "arguments.h"

#include <fmt/format.h>
#include <algorithm>

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

#include "aplomb/core/printable.h"
#include "flags.h"
#include "outputs.h"
#include "talk.h"

namespace aplomb::cli {
namespace {

constexpr int usage_exit = 1, unusable_exit = 2;

std::vector<std::pair<std::string, std::string>> flags_given(const CLI::App& app) {
  std::vector<std::pair<std::string, std::string>> given;
  for (const CLI::Option* option : app.get_options())
    if (option->count() > 0 && !option->get_lnames().empty())
      given.emplace_back(option->get_lnames().front(), fmt::format("{}", fmt::join(option->results(), " ")));
  return given;
}

int usage_error(const std::string& problem) {
  fmt::print(stderr, "aplomb: {}\n", printable(problem, longest_message));
  return usage_exit;
}

/// What `aplomb run` may change of a job.
struct JobOverrides {
  std::filesystem::path file, output, report, html, picture;
  std::optional<int> threads;
};

void add_job_flags(CLI::App* app, JobOverrides& overrides, Arguments& a) {
  app->add_option("JOB", overrides.file, "JSON file as lib/aplomb/job/job.schema.json describes")->required();
  app->add_option("-o,--output", overrides.output, "instead of the job's; without any the poses are only checked");
  app->add_option("--report", overrides.report, "instead of the job's");
  app->add_option("--html", overrides.html, "instead of the job's");
  app->add_option("--picture", overrides.picture, "instead of the job's");
  app->add_option("--threads", overrides.threads, "instead of the job's")->check(CLI::NonNegativeNumber);
  add_time_flag(app, a);
  add_progress_flag(app, a);
  app->add_flag("-q,--quiet", a.quiet, "no progress and no summary");
}

Result<JobFile> job_of(const JobOverrides& overrides) {
  auto job = read_job(overrides.file);
  if (!job) return job;
  if (!overrides.output.empty()) job->output = overrides.output;
  if (!overrides.report.empty()) job->report = overrides.report;
  if (!overrides.html.empty()) job->html = overrides.html;
  if (!overrides.picture.empty()) job->picture = overrides.picture;
  job->threads = overrides.threads.value_or(job->threads);
  return job;
}

/// The flags of every command that reads a model.
void add_flags(Command command, CLI::App* app, Arguments& a, StandingPose& standing, HangingPose& hanging) {
  const bool carves = command == Command::stand || command == Command::hang;
  const bool judges = carves || command == Command::validate;
  add_input_flags(app, a);
  if (command == Command::hang) add_hanging_flags(app, hanging);
  else if (command != Command::poses) add_standing_flags(app, a, standing);
  if (judges) add_judging_flags(app, a);
  if (carves) {
    add_carving_flags(app, a);
    add_ballast_flags(app, a);
    add_reshaping_flags(app, a);
  }
  if (carves || command == Command::check) add_profile_flag(app, a);
  if (command != Command::poses) app->add_option("--html", a.job.html, "write the report as a page for people");
  if (carves || command == Command::check)
    app->add_option("--picture", a.job.picture, "draw it before and after, and cut open, as PNG");
  add_run_flags(app, a);
}

Parsed finish_verify(Arguments a) {
  for (const std::string& problem : {find_problem(a.verify.gcode), find_problem(a.verify.options), find_clash(a)})
    if (!problem.empty()) return {std::nullopt, usage_error(problem)};
  return {std::move(a), 0};
}

}  // namespace

Parsed parse_arguments(int argc, char** argv) {
  Arguments a;
  JobOverrides overrides;
  StandingPose standing;
  HangingPose hanging;
  CLI::App app(
      "Aplomb makes 3D prints stand: it carves a void that moves the centre of mass, and measures the result.");
  app.set_version_flag("--version", "aplomb " APLOMB_VERSION);
  app.require_subcommand(1);
  const std::vector<std::pair<Command, CLI::App*>> commands{
      {Command::check, app.add_subcommand("check", "say whether a model stands, and by how many degrees")},
      {Command::stand, app.add_subcommand("stand", "carve a model so that it stands")},
      {Command::hang, app.add_subcommand("hang", "carve a model so that it hangs level from one or two points")},
      {Command::poses, app.add_subcommand("poses", "list the ways a model can rest, and how likely each is")},
      {Command::validate, app.add_subcommand("validate", "judge whether a mesh prints, as it is")},
      {Command::verify, app.add_subcommand("verify", "measure what a G-code file prints, and whether that stands")},
      {Command::run, app.add_subcommand("run", "run a job file")}};
  app.add_subcommand("studio", "open an editor in the browser");  // another program: see main()
  for (const auto& [command, sub] : commands)
    if (command == Command::run) add_job_flags(sub, overrides, a);
    else if (command == Command::verify) add_verify_flags(sub, a);
    else add_flags(command, sub, a, standing, hanging);
  app.footer(
      "Exit: 0 stands, or prints; 1 usage; 2 input unusable; 3 cannot stand; 4 cancelled; 5 over budget; 6 does not "
      "print, or not as told; 7 internal.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::stringstream said;  // of words that a pattern of names may have brought
    const int code = app.exit(error, std::cout, said);
    for (std::string line; std::getline(said, line);) fmt::print(stderr, "{}\n", printable(line, longest_message));
    return {std::nullopt, code == 0 ? 0 : usage_exit};
  }
  for (const auto& [command, sub] : commands)
    if (sub->parsed()) a.command = command, a.given = flags_given(*sub);
  if (a.command == Command::verify) return finish_verify(std::move(a));
  a.job.input.read.memory_bytes = a.job.options.memory_bytes;
  if (a.command == Command::hang) a.job.poses.front().pose.way = hanging;
  else a.job.poses.front().pose.way = standing;
  a.job.input.hint_at_resting = a.command == Command::check || a.command == Command::stand;
  if (a.command == Command::run) {
    auto job = job_of(overrides);
    if (!job) {
      usage_error(job.error().message);
      return {std::nullopt, job.error().code == ErrorCode::file_system ? unusable_exit : usage_exit};
    }
    a.given.emplace_back("job", overrides.file.string());
    a.job_file = overrides.file;
    a.job = std::move(*job);
  }
  a.job.input.repair.step_memory_mb =
      std::clamp<std::size_t>(a.job.options.memory_bytes >> 20, 1, a.job.input.repair.step_memory_mb);
  for (const std::string& problem : {find_problem(a.job), find_clash(a)})
    if (!problem.empty()) return {std::nullopt, usage_error(problem)};
  return {std::move(a), 0};
}

}  // namespace aplomb::cli
