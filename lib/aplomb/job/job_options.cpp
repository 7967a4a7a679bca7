#include <fmt/format.h>

#include <array>
#include <fstream>
#include <utility>

#include "aplomb/job/job_file.h"

namespace aplomb {
namespace {

using Preset = std::pair<std::string_view, double>;

template <std::size_t N>
std::optional<double> value_named(const std::array<Preset, N>& presets, std::string_view name) {
  for (const auto& [known, value] : presets)
    if (known == name) return value;
  return std::nullopt;
}

StandOptions without_contacts(const JobFile& job) {
  StandOptions options = job.options;
  options.poses.clear();
  for (const JobPose& pose : job.poses) options.poses.push_back(pose.pose);
  return options;
}

/// Whether what is written can say where infill is to be denser.
bool holds_ballast(const JobFile& job) {
  const auto format = format_of(job.output);
  return job.output.empty() || !job.modifier.empty() || (format && *format == MeshFormat::three_mf);
}

}  // namespace

std::optional<double> density_of_material(std::string_view name) {
  constexpr std::array<Preset, 7> densities{Preset{"pla", 1.24}, {"petg", 1.27},  {"abs", 1.04}, {"asa", 1.07},
                                            {"tpu", 1.22},       {"resin", 1.15}, {"pa12", 1.01}};
  return value_named(densities, name);
}

std::optional<double> wall_of_process(std::string_view name) {
  constexpr std::array<Preset, 4> walls{Preset{"fdm", 1.6}, {"sla", 2.0}, {"powder", 1.5}, {"binder", 3.0}};
  return value_named(walls, name);
}

Result<JudgeOptions> judge_options(const JobFile& job) {
  auto rules = rules_of(job.rules);
  if (!rules) return tl::unexpected(rules.error());
  JudgeOptions options{std::move(*rules), {}, {.infill_ratio = job.infill_percent / 100}};
  options.fem = job.fem;
  if (std::string problem = find_problem(options); !problem.empty())
    return fail(ErrorCode::invalid_option, std::move(problem));
  return options;
}

StandOptions stand_options(const JobFile& job, double height_mm) {
  StandOptions options = without_contacts(job);
  if (auto judging = judge_options(job)) options.judge = std::move(*judging);
  for (const std::string& text : job.inserts)
    if (auto stock = parse_insert(text)) options.inserts.push_back(std::move(*stock));
  for (std::size_t i = 0; i < job.poses.size(); ++i)
    if (auto* standing = std::get_if<StandingPose>(&options.poses[i].way))
      for (const JobContact& contact : job.poses[i].contacts)
        standing->contacts.push_back({contact.center_mm, contact.radius_mm.value_or(0.05 * height_mm)});
  return options;
}

Result<StandOptions> with_profile(StandOptions options, const JobFile& job) {
  if (!holds_ballast(job)) options.ballast = Ballasting::never;
  if (job.profile.empty()) return options;
  const auto profile = read_profile(job.profile);
  if (!profile) return tl::unexpected(profile.error());
  options.profile = *profile;
  if (std::string problem = find_problem(options); !problem.empty())
    return fail(ErrorCode::invalid_option, std::move(problem));
  return options;
}

std::string find_problem(const JobFile& job) {
  if (job.options.ballast == Ballasting::only && job.profile.empty())
    return "ballast is infill of more than one density; name the profile that it is sliced with";
  if (job.options.ballast == Ballasting::only && !holds_ballast(job))
    return fmt::format("{} cannot hold ballast; write a .3mf, or the volume of denser infill on its own (modifier)",
                       job.output.string());
  for (const std::string& text : job.inserts)
    if (const auto stock = parse_insert(text); !stock) return stock.error().message;
  for (std::string problem : {find_problem(job.input.placement), find_problem(job.input.repair),
                              find_problem(job.input.read), find_problem(stand_options(job, 1))})
    if (!problem.empty()) return problem;
  if (const auto judging = judge_options(job); !judging) return judging.error().message;
  if (job.time_s && !(*job.time_s > 0 && *job.time_s <= 1e7))
    return fmt::format("time_s is {}; it must lie in (0, 1e7]", *job.time_s);
  if (job.threads < 0) return fmt::format("threads is {}; it must be at least 0", job.threads);
  return {};
}

Result<JobFile> read_job(const std::filesystem::path& file) {
  constexpr std::streamsize most_bytes = 1'000'000;
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(most_bytes + 1), '\0');
  stream.read(text.data(), most_bytes + 1);
  if (stream.bad() || (stream.gcount() == 0 && !stream.eof()))
    return fail(ErrorCode::file_system, fmt::format("{}: the job cannot be read; check its name", file.string()));
  if (stream.gcount() > most_bytes)
    return fail(
        ErrorCode::invalid_option,
        fmt::format("{}: it is longer than 1 MB, as no job is; give a file that --save-job wrote", file.string()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  auto job = parse_job(text, file.parent_path());
  if (!job) return fail(job.error().code, fmt::format("{}: {}", file.string(), job.error().message));
  return job;
}

}  // namespace aplomb
