#include "run.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>

#include "aplomb/balance/landing.h"
#include "aplomb/ballasted.h"
#include "aplomb/core/stage_clock.h"
#include "aplomb/core/threads.h"
#include "aplomb/ending.h"
#include "aplomb/inserted.h"
#include "aplomb/inserts/pause.h"
#include "aplomb/io/write_mesh.h"
#include "aplomb/printability/judge.h"
#include "aplomb/report/json.h"
#include "aplomb/report/judgement.h"
#include "aplomb/report/landing_list.h"
#include "aplomb/report/text.h"
#include "comparison.h"
#include "interrupt.h"
#include "memory_limit.h"
#include "page.h"
#include "run_verify.h"
#include "talk.h"

namespace aplomb::cli {
namespace {

StageViewer dump_into(const std::filesystem::path& folder) {
  if (folder.empty()) return {};
  return [folder](std::string_view name, const TriangleMesh& mesh) {
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    const auto written = write_mesh(folder / fmt::format("{}.ply", name), mesh);
    if (!written) fmt::print(stderr, "aplomb: --dump: {}\n", written.error().message);
  };
}

/// Of this process, or of the largest child that repaired something, whichever took more.
double peak_memory_mb() {
  rusage own{}, children{};
  getrusage(RUSAGE_SELF, &own);
  getrusage(RUSAGE_CHILDREN, &children);
  return static_cast<double>(std::max(own.ru_maxrss, children.ru_maxrss)) / 1024;
}

/// Says it on standard output when it is the answer, and nothing else is written there.
void say(const Arguments& a, const std::string& text, bool is_answer) {
  if (!a.quiet) fmt::print(is_answer && a.job.report != "-" ? stdout : stderr, "{}", text);
}

/// Completes the report with what only the program knows, and writes it where it was asked for: before pictures and
/// pages, which take their time, so that a program that waits for it need not.
Result<void> publish(Report report, const Arguments& a) {
  for (const auto& [flag, value] : a.given) report.options.emplace_back(flag, value);
  report.peak_memory_mb = peak_memory_mb();
  say(a, to_text(report), a.job.output.empty());
  return a.job.report.empty() ? Result<void>{} : write_text(a.job.report, to_json(report));
}

/// Writes the plugs of the escape holes as one file of several parts, laid where they belong.
Result<void> write_plugs(const StandRun& made, const Arguments& a, const Job& job) {
  if (a.job.plugs.empty() || made.holes.empty()) return {};
  const auto parts = hole_plugs(made, job.part(0, 0.8));
  if (!parts) return tl::unexpected(parts.error());
  TriangleMesh all;
  for (const TriangleMesh& plug : *parts) all = joined(std::move(all), plug);
  return write_mesh(a.job.plugs, all,
                    WriteOptions{.name = a.job.plugs.stem().string(), .on_temp_file = remember_temp_file},
                    job.part(0.8, 1));
}

/// What goes into a 3MF beside the model.
std::vector<PackagePart> parts_of(const Report& report) {
  if (!report.inserts || report.inserts->pockets.empty()) return {};
  std::vector<Pause> pauses;
  for (const PocketFigures& pocket : report.inserts->pockets)
    pauses.push_back({pocket.first_print_mm, fmt::format("put {} x {} in", pocket.count, pocket.name)});
  return {{prusaslicer_pauses_path, prusaslicer_pauses(std::move(pauses))}};
}

/// Where the pauses for inserts are, and for which layers.
void add_pause_hint(Report& report, MeshFormat format) {
  if (!report.inserts || report.inserts->pockets.empty()) return;
  report.hints.push_back(
      fmt::format("{}; the pockets are for layers of {:g} mm: other layers need --layer or --profile",
                  format == MeshFormat::three_mf
                      ? "PrusaSlicer finds the pauses in the 3MF; in another slicer set them at these heights"
                      : "set the pauses at these heights in the slicer; a 3MF would hold them for PrusaSlicer",
                  report.inserts->layer_mm));
}

InfillModifier modifier_of(const StandRun& made, const Input& input, const Arguments& a, const StandOptions& options) {
  const bool is_cura = options.profile->rules == PrintProfile::Rules::cura;
  return {a.job.flavor.value_or(is_cura ? Flavor::cura : Flavor::prusaslicer),
          ballast_volume(*made.ballast, input.solid.box()), made.ballast->infill.infill_ratio,
          options.ballast_low_ratio};
}

/// Measures what the file of the shell holds, and writes it where it prints or the best effort was asked for.
Result<Report> measure_and_write(const StandRun& made, const Input& input, const Arguments& a,
                                 const StandOptions& options, const Job& job) {
  const std::filesystem::path& output = a.job.output;
  const MeshFormat format = output == "-" ? MeshFormat::stl : *format_of(output);
  WriteOptions write{.name = output.stem().string(), .on_temp_file = {}};
  if (format == MeshFormat::three_mf) {
    write.parts = parts_of(made.report);
    if (made.ballast) write.modifier = modifier_of(made, input, a, options);
  }
  auto bytes = encode_mesh(made.shell->mesh, format, write, job.part(0, 0.4));
  if (!bytes) return tl::unexpected(bytes.error());
  const auto back =
      read_mesh(*bytes, output == "-" ? "standard output.stl" : output.filename().string(), {}, job.part(0.4, 0.6));
  if (!back) return tl::unexpected(back.error());
  auto report = measure_output(rounded_to_float(back->objects.front().mesh), input, made, options, job.part(0.6, 1));
  if (!report) return report;
  if (auto why = refusal(*report, options)) {
    report->hints.push_back(std::move(*why));
    return report;
  }
  if (const auto written = write_file_atomically(output, *bytes, remember_temp_file); !written)
    return tl::unexpected(written.error());
  if (made.ballast && !a.job.modifier.empty()) {
    const WriteOptions named{.name = a.job.modifier.stem().string(), .on_temp_file = remember_temp_file};
    const auto volume = ballast_volume(*made.ballast, input.solid.box());
    if (const auto written = write_mesh(a.job.modifier, volume, named); !written)
      return tl::unexpected(written.error());
  }
  if (const auto plugged = write_plugs(made, a, job); !plugged) return tl::unexpected(plugged.error());
  add_pause_hint(*report, format);
  if (!a.job.plugs.empty() && made.holes.empty()) report->hints.emplace_back("no escape holes were cut: no plugs");
  return report;
}

constexpr int picture_size = 600;  // pixels across one of its parts

/// Draws what came, and what became of it where there is something.
Result<void> draw(const Arguments& a, const Input& input, const StandRun* made, const StandOptions& options,
                  const Job& job) {
  if (a.job.picture.empty()) return {};
  const TriangleMesh& before = input.solid.mesh();
  const auto image = made && made->shell
                         ? picture::before_and_after(before, made->shell->mesh, options.poses, picture_size, {}, job,
                                                     inserts_as_solid(made->inserts, options))
                         : picture::as_it_is(before, options.poses, picture_size, {}, job);
  if (!image) return tl::unexpected(image.error());
  const auto bytes = picture::encode_png(*image, job);
  if (!bytes) return tl::unexpected(bytes.error());
  return write_file_atomically(a.job.picture, *bytes, remember_temp_file);
}

/// Writes the page where one is asked for.
Result<void> write_page(const Arguments& a, const page::PageContent& content, const Job& job) {
  if (a.job.html.empty()) return {};
  const auto html = page::html_page(content, job);
  if (!html) return tl::unexpected(html.error());
  return write_text(a.job.html, *html);
}

/// The page of a run that has a report.
Result<void> write_page(const Arguments& a, const Report& report, const Input& input, const StandRun* made,
                        const StandOptions& options, const Job& job) {
  page::PageContent content{
      .title = a.job.model.filename().string(), .before = &input.solid.mesh(), .poses = options.poses};
  if (made && made->shell) content.after = &made->shell->mesh;
  if (made) content.inserts = inserts_as_solid(made->inserts, options);
  content.report = report;
  content.judgement = report.judgement;
  content.required_tip_rad = report.required_tip_rad;
  if (report.has_standing_pose()) content.standing = report.after ? *report.after : report.before;
  return write_page(a, content, job);
}

int run_stand(const Arguments& a, const Input& input, const StandOptions& options, const Job& job) {
  auto made = stand(input, options, job.part(0, 0.8), dump_into(a.job.dump));
  if (!made) return report_error(made.error());
  Report report = made->report;
  const bool writes = made->shell && (report.outcome != Outcome::best_effort || options.best_effort);
  if (writes) {
    StageSeconds seconds = made->report.stage_seconds;
    StageClock clock(seconds);
    auto measured = measure_and_write(*made, input, a, options, job.part(0.8, 0.9));
    if (!measured) return report_error(measured.error());
    clock.lap("write");
    report = std::move(*measured);
    report.stage_seconds = std::move(seconds);
  }
  if (const auto published = publish(report, a); !published) return report_error(published.error());
  if (const auto drawn = draw(a, input, writes ? &*made : nullptr, options, job.part(0.9, 0.95)); !drawn)
    return report_error(drawn.error());
  if (const auto paged = write_page(a, report, input, writes ? &*made : nullptr, options, job.part(0.95, 1)); !paged)
    return report_error(paged.error());
  return exit_code(ending_of(report));
}

int run_check(const Arguments& a, const Input& input, const StandOptions& options, const Job& job) {
  auto report = check(input, options, job.part(0, 0.5));
  if (!report) return report_error(report.error());
  if (const auto drawn = draw(a, input, nullptr, options, job.part(0.5, 0.8)); !drawn)
    return report_error(drawn.error());
  if (const auto paged = write_page(a, *report, input, nullptr, options, job.part(0.8, 1)); !paged)
    return report_error(paged.error());
  if (const auto published = publish(*report, a); !published) return report_error(published.error());
  return exit_code(ending_of(*report));
}

/// How the judged mesh stands, for the page; nothing where that cannot be measured.
std::optional<Standing> standing_of(const TriangleMesh& mesh, const std::optional<StandingPose>& pose) {
  const Region body{moments(mesh), 1, 0};
  if (!pose || !(body.moments.volume_mm3 > 0)) return std::nullopt;
  auto standing = measure_standing(mesh, {&body, 1}, *pose);
  return standing ? std::optional(std::move(*standing)) : std::nullopt;
}

int run_validate(const Arguments& a, const Job& job) {
  const auto mesh = load_print(a.job.model, a.job.input, job.part(0, 0.1));
  if (!mesh) return report_error(mesh.error());
  const StandOptions options = stand_options(a.job, bounding_box(*mesh).size().z);
  JudgeOptions judging = options.judge;
  judging.pose = *options.poses.front().standing();
  judging.density_g_per_cm3 = options.density_g_per_cm3;
  const auto judgement = judge(*mesh, judging, nullptr, job.part(0.1, a.job.html.empty() ? 1 : 0.7));
  if (!judgement) return report_error(judgement.error());
  say(a, to_text(*judgement), true);
  if (!a.job.report.empty())
    if (const auto written = write_text(a.job.report, to_json(*judgement)); !written)
      return report_error(written.error());
  page::PageContent content{.title = a.job.model.filename().string(), .after = &*mesh, .poses = options.poses};
  content.judgement = *judgement;
  content.standing = standing_of(*mesh, judging.pose);
  content.required_tip_rad = judging.pose->required_tip_rad;
  if (const auto written = write_page(a, content, job.part(0.7, 1)); !written) return report_error(written.error());
  return exit_code(ending_of(*judgement));
}

int list_poses(const Arguments& a, const Input& input) {
  const auto found = landings(input.solid.mesh(), input.moments, 1e-3 * input.solid.box().diagonal());
  if (!found) return report_error(found.error());
  say(a, to_text(*found), true);
  if (!a.job.report.empty())
    if (const auto written = write_text(a.job.report, to_json(*found)); !written) return report_error(written.error());
  return exit_code(Ending::stands);
}

/// Writes the command as a job, before it is run.
Result<void> save_job(const Arguments& a) {
  if (a.save_job.empty()) return {};
  const auto folder = a.save_job == "-" ? std::filesystem::path(".") : a.save_job.parent_path();
  return write_text(a.save_job, to_json(a.job, folder));
}

}  // namespace

int run(const Arguments& a) {
  if (const auto time_s = a.time_s ? a.time_s : a.job.time_s; time_s)
    limit_time(*time_s, exit_code(Ending::over_budget));
  limit_memory(a.job.options.memory_bytes, exit_code(Ending::over_budget));
  if (a.command == Command::verify) {
    ProgressLine progress(!a.quiet, a.is_progress_json);
    return run_verify(a, progress.job());
  }
  const JobFile& asked = a.job;
  for (const std::filesystem::path& file : {asked.output, asked.plugs, asked.modifier})
    if (!file.empty() && file != "-")
      if (const auto format = format_of(file); !format) return report_error(format.error());
  if (const auto saved = save_job(a); !saved) return report_error(saved.error());
  const ThreadLimit limit(asked.threads);
  ProgressLine progress(!a.quiet, a.is_progress_json);
  const Job job = progress.job();
  if (a.command == Command::validate) return run_validate(a, job);
  const auto input = load_solid(asked.model, asked.input, job.part(0, 0.3), dump_into(asked.dump));
  if (!input) return report_error(input.error());
  if (a.command == Command::poses) return list_poses(a, *input);
  const auto options = with_profile(stand_options(asked, input->solid.box().size().z), asked);
  if (!options) return report_error(options.error());
  return asked.output.empty() ? run_check(a, *input, *options, job.part(0.3, 1))
                              : run_stand(a, *input, *options, job.part(0.3, 1));
}

}  // namespace aplomb::cli
