#include "run.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <span>

#include "aplomb/core/stage_clock.h"
#include "aplomb/core/threads.h"
#include "aplomb/io/write_mesh.h"
#include "aplomb/report/json.h"
#include "aplomb/report/text.h"
#include "interrupt.h"

namespace aplomb::cli {
namespace {

enum Exit { stands = 0, usage = 1, bad_input = 2, cannot_stand = 3, over_budget = 5, internal = 7 };

int exit_code(const Error& error) {
  switch (error.code) {
    case ErrorCode::invalid_option:
      return Exit::usage;
    case ErrorCode::unusable_input:
    case ErrorCode::file_system:
      return Exit::bad_input;
    case ErrorCode::cancelled:
      return cancelled_exit;
    case ErrorCode::over_budget:
      return Exit::over_budget;
    default:
      return Exit::internal;
  }
}

int report_error(const Error& error) {
  fmt::print(stderr, "aplomb: {}\n", error.message);
  return exit_code(error);
}

/// A line that is written over, on a terminal; nothing elsewhere. Its end also wipes it.
class ProgressLine {
 public:
  explicit ProgressLine(bool shown) : shown_(shown && isatty(STDERR_FILENO) == 1) {}
  ~ProgressLine() {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }
  Job job() {
    return Job([this](double fraction, std::string_view stage) {
      show(fraction, stage);
      return !interrupted();
    });
  }

 private:
  void show(double fraction, std::string_view stage) {
    const auto now = std::chrono::steady_clock::now();
    if (!shown_ || now - last_ < std::chrono::milliseconds(50)) return;
    last_ = now;
    fmt::print(stderr, "\r\033[K{:3.0f} % {}", 100 * fraction, stage);
  }

  bool shown_;
  std::chrono::steady_clock::time_point last_{};
};

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

/// Completes the report with what only the program knows, and writes it where it was asked for.
Result<void> publish(Report& report, const Arguments& a) {
  for (const auto& [flag, value] : a.given) report.options.emplace_back(flag, value);
  report.peak_memory_mb = peak_memory_mb();
  if (!a.quiet) fmt::print(a.command == Command::check && a.report != "-" ? stdout : stderr, "{}", to_text(report));
  if (a.report.empty()) return {};
  const std::string json = to_json(report);
  return write_file_atomically(a.report, std::as_bytes(std::span(json)), remember_temp_file);
}

/// Writes the shell, reads it back and measures what the file holds.
Result<Report> write_and_measure(const StandRun& made, const Arguments& a, const Job& job) {
  const MeshFormat format = a.output == "-" ? MeshFormat::stl : *format_of(a.output);
  auto bytes = encode_mesh(made.shell->mesh, format, WriteOptions{a.output.stem().string(), {}}, job.part(0, 0.4));
  if (!bytes) return tl::unexpected(bytes.error());
  const auto back =
      read_mesh(*bytes, a.output == "-" ? "standard output.stl" : a.output.filename().string(), {}, job.part(0.4, 0.6));
  if (!back) return tl::unexpected(back.error());
  auto report = measure_output(rounded_to_float(back->objects.front().mesh), made, a.stand, job.part(0.6, 1));
  if (!report) return report;
  if (const auto written = write_file_atomically(a.output, *bytes, remember_temp_file); !written)
    return tl::unexpected(written.error());
  return report;
}

int run_stand(const Arguments& a, const Input& input, const Job& job) {
  auto made = stand(input, a.stand, job.part(0, 0.8), dump_into(a.dump));
  if (!made) return report_error(made.error());
  Report report = made->report;
  const bool writes = made->shell && (report.outcome != Outcome::best_effort || a.stand.best_effort);
  if (writes) {
    StageSeconds seconds = made->report.stage_seconds;
    StageClock clock(seconds);
    auto measured = write_and_measure(*made, a, job.part(0.8, 1));
    if (!measured) return report_error(measured.error());
    clock.lap("write");
    report = std::move(*measured);
    report.stage_seconds = std::move(seconds);
  }
  if (const auto published = publish(report, a); !published) return report_error(published.error());
  return report.outcome == Outcome::best_effort ? Exit::cannot_stand : Exit::stands;
}

}  // namespace

int run(const Arguments& arguments) {
  Arguments a = arguments;
  if (a.command == Command::stand && a.output != "-")
    if (const auto format = format_of(a.output); !format) return report_error(format.error());
  const ThreadLimit limit(a.threads);
  ProgressLine progress(!a.quiet);
  const Job job = progress.job();
  const auto input = load_solid(a.model, a.input, job.part(0, 0.3), dump_into(a.dump));
  if (!input) return report_error(input.error());
  const auto contacts = contacts_of(a.contacts, input->solid.box().size().z);
  if (!contacts) return report_error(contacts.error());
  a.stand.pose.contacts = *contacts;
  if (a.command == Command::stand) return run_stand(a, *input, job.part(0.3, 1));
  auto report = check(*input, a.stand, job.part(0.3, 1));
  if (!report) return report_error(report.error());
  if (const auto published = publish(*report, a); !published) return report_error(published.error());
  return report->outcome == Outcome::falls ? Exit::cannot_stand : Exit::stands;
}

}  // namespace aplomb::cli
