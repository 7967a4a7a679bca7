#include "solver/solver.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <tuple>

#include "aplomb/ending.h"
#include "aplomb/io/write_mesh.h"
#include "aplomb/pipeline.h"
#include "aplomb/report/json.h"
#include "aplomb/report/judgement.h"
#include "aplomb/report/text.h"
#include "memory_limit.h"
#include "solver/desk.h"
#include "solver/outbox.h"
#include "solver/preview.h"
#include "solver/surfaces.h"
#include "wire/messages.h"

namespace aplomb::studio {
namespace {

using Json = nlohmann::ordered_json;

/// More than a browser shows.
constexpr std::size_t most_triangles = 5'000'000;

Json json_of(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

Json json_of(const Affine3& t) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row)
    for (const double entry : {t.linear.rows[row].x, t.linear.rows[row].y, t.linear.rows[row].z, t.translation[row]})
      rows.push_back(entry);
  return rows;
}

std::string placed_message(const Input& input) {
  const Box3& box = input.solid.box();
  Json notes = input.repair.steps;
  for (const std::string& note : input.notes) notes.push_back(note);
  const Json message{{"type", "placed"},
                     {"triangles", input.solid.mesh().triangles.size()},
                     {"box_mm", Json::array({json_of(box.min), json_of(box.max)})},
                     {"volume_mm3", input.moments.volume_mm3},
                     {"center_mm", json_of(input.moments.centroid_mm())},
                     {"from_file", json_of(input.from_file)},
                     {"notes", std::move(notes)}};
  return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

JobFile limited(JobFile job) {
  job.input.read.max_triangles = std::min(job.input.read.max_triangles, most_triangles);
  return job;
}

class Solver {
 public:
  Solver(Outbox& out, Desk& desk, const SolverRequest& request) : out_(out), desk_(desk), request_(request) {}

  /// Makes the cage before the first drag asks for it, unless something else is asked for.
  void get_ready(Inbox& inbox) {
    if ((request_.what != "place" && request_.what != "check") || !desk_.has_solid()) return;
    const Job work([&inbox](double, std::string_view) { return !inbox.has_other_than_preview(); });
    const auto job = parse_bending_job(request_.job);
    if (!job) return;
    const auto input = desk_.solid(request_.folder, limited(*job), work);
    if (input) std::ignore = desk_.bender(**input, stand_options(*job, (*input)->solid.box().size().z), work);
  }

  Result<void> answer() {
    std::error_code moved;
    std::filesystem::current_path(request_.folder, moved);
    if (moved) return fail(ErrorCode::file_system, "the model's folder is gone");
    if (request_.what == "result") return show_result();
    auto job = request_.what == "preview" ? parse_bending_job(request_.job) : parse_job(request_.job, "");
    if (!job) return tl::unexpected(job.error());
    *job = limited(std::move(*job));
    if (request_.what == "place") return place(*job);
    if (request_.what == "check") return check(*job);
    if (request_.what == "validate") return validate(*job);
    if (request_.what == "preview") return bend(*job);
    return fail(ErrorCode::internal, "the solver does not know how to " + request_.what);
  }

 private:
  Result<void> place(const JobFile& job) {
    const auto input = desk_.solid(request_.folder, job, out_.work(false));
    if (!input) return tl::unexpected(input.error());
    out_.json(placed_message(**input));
    out_.mesh("model", (*input)->solid.mesh());
    return {};
  }

  Result<void> check(const JobFile& job) {
    const Job work = out_.work(false);
    const auto input = desk_.solid(request_.folder, job, work.part(0, 0.5));
    if (!input) return tl::unexpected(input.error());
    const auto options = with_profile(stand_options(job, (*input)->solid.box().size().z), job);
    if (!options) return tl::unexpected(options.error());
    const auto report = aplomb::check(**input, *options, work.part(0.5, 1));
    if (!report) return tl::unexpected(report.error());
    out_.json(wrapped_message("report", "report", to_json(*report), verdict(*report)));
    return {};
  }

  Result<void> bend(const JobFile& job) {
    const auto input = desk_.solid(request_.folder, job, out_.work(false));
    if (!input) return tl::unexpected(input.error());
    return preview(job, request_.wish, **input, desk_, out_);
  }

  /// As `aplomb validate` does it.
  Result<void> validate(const JobFile& job) {
    const Job work = out_.work(true);
    const auto mesh = load_print(job.model, job.input, work.part(0, 0.1));
    if (!mesh) return tl::unexpected(mesh.error());
    const StandOptions options = stand_options(job, bounding_box(*mesh).size().z);
    JudgeOptions judging = options.judge;
    if (const StandingPose* standing = options.poses.front().standing()) judging.pose = *standing;
    judging.density_g_per_cm3 = options.density_g_per_cm3;
    const auto judgement = judge(*mesh, judging, nullptr, work.part(0.1, 1));
    if (!judgement) return tl::unexpected(judgement.error());
    out_.json(wrapped_message("judgement", "judgement", to_json(*judgement)));
    return {};
  }

  /// What a run has written, taken apart into its surfaces.
  Result<void> show_result() {
    const Job work = out_.work(false);
    const auto file = read_mesh(request_.file, {}, work);
    if (!file) return tl::unexpected(file.error());
    const TriangleMesh& mesh = file->objects.front().mesh;
    if (!request_.stl.empty()) {
      const std::filesystem::path stl = request_.stl;
      if (const auto written = write_mesh(stl, mesh, {.name = stl.stem().string(), .on_temp_file = {}}); !written)
        return tl::unexpected(written.error());
    }
    for (const Surface& surface : surfaces_of(mesh)) out_.mesh(surface.is_void ? "void" : "outside", surface.mesh);
    if (request_.dense.empty() || !std::filesystem::exists(request_.dense)) return {};
    const auto dense = read_mesh(request_.dense, {}, work);
    if (!dense) return tl::unexpected(dense.error());
    out_.mesh("dense", dense->objects.front().mesh);
    return {};
  }

  Outbox& out_;
  Desk& desk_;
  const SolverRequest& request_;
};

}  // namespace

int run_solver() {
  const int answers = dup(STDOUT_FILENO);  // what a library prints must not come between
  if (answers < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return static_cast<int>(Ending::internal);
  signal(SIGPIPE, SIG_IGN);
  cli::limit_memory(StandOptions{}.memory_bytes, static_cast<int>(Ending::over_budget));
  Inbox inbox(STDIN_FILENO);
  Desk desk;
  for (;;) {
    const SolverRequest request = inbox.next();
    Outbox out(answers, inbox, request);
    try {
      Solver solver(out, desk, request);
      if (const auto answered = solver.answer(); !answered) out.json(error_message(answered.error()));
      out.end();
      solver.get_ready(inbox);
    } catch (const std::bad_alloc&) {
      std::cerr << "aplomb: memory ran out\n";
      return static_cast<int>(Ending::over_budget);
    } catch (const std::exception& error) {  // a bug
      std::cerr << "aplomb: internal error: " << error.what() << '\n';
      return static_cast<int>(Ending::internal);
    }
  }
}

}  // namespace aplomb::studio
