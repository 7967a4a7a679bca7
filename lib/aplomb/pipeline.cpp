#include "aplomb/pipeline.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "aplomb/balance/resting.h"
#include "aplomb/balance/standing.h"
#include "aplomb/balance/standing_rows.h"
#include "aplomb/mesh/bodies.h"
#include "aplomb/report/text.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double aimed_beyond_rad = 0.004 * degree;  // what simplifying the shell may cost
constexpr int most_carvings = 3;

std::string several_prints(const std::vector<TriangleMesh>& prints) {
  std::string list;
  for (std::size_t i = 0; i < prints.size() && i < 10; ++i) {
    const Vec3 size = bounding_box(prints[i]).size();
    list += fmt::format("{}{}: {:.4g} x {:.4g} x {:.4g} mm, {} triangles", i == 0 ? "" : "; ", i + 1, size.x, size.y,
                        size.z, prints[i].triangles.size());
  }
  return fmt::format("the file holds {} prints that do not touch ({}{}): choose one with --object N", prints.size(),
                     list, prints.size() > 10 ? "; ..." : "");
}

TriangleMesh all_objects(const MeshFile& file) {
  TriangleMesh all;
  for (const MeshObject& part : file.objects) all = joined(std::move(all), part.mesh);
  return all;
}

/// Everything in the file that touches is one print. Without a number all of them are taken, and `several` says how
/// many there are: an open surface may look like several until it is repaired.
Result<TriangleMesh> choose_print(const MeshFile& file, std::optional<std::size_t> object, std::string& several) {
  TriangleMesh all = all_objects(file);
  std::vector<TriangleMesh> prints = split_prints(all);
  if (!object) {
    if (prints.size() > 1) several = several_prints(prints);
    return all;
  }
  if (*object < 1 || *object > prints.size())
    return fail(ErrorCode::invalid_option,
                fmt::format("--object is {}; the file holds {} prints, counted from 1", *object, prints.size()));
  return std::move(prints[*object - 1]);
}

/// A unit given by the user replaces the file's, which the reader has applied.
PlacementOptions with_file_unit(PlacementOptions placement, const MeshFile& file) {
  if (placement.unit_mm) placement.unit_mm = *placement.unit_mm / file.unit_mm;
  return placement;
}

std::array<Region, 1> uniform_body(const Moments& body, const StandOptions& options) {
  return {Region{body, options.density_g_per_cm3, 0.02}};
}

double asked_tip_rad(const Standing& standing, const StandOptions& options) {
  return options.robust ? standing.stability.robust_tip_rad : standing.stability.tip_rad;
}

Result<Standing> standing_of(const TriangleMesh& outer, const Moments& body, const StandOptions& options) {
  return measure_standing(outer, uniform_body(body, options), options.pose);
}

Report begin_report(const Input& input, const StandOptions& options, const Standing& before) {
  Report report;
  report.version = APLOMB_VERSION;
  report.required_tip_rad = options.pose.required_tip_rad;
  report.before = before;
  report.repair = input.repair.steps;
  report.hints = input.notes;
  report.stage_seconds = input.stage_seconds;
  report.mesh =
      MeshFigures{input.repair.outer_unchanged, true, 0, input.solid.voids(), input.solid.mesh().triangles.size()};
  return report;
}

BalanceProblem rows_of(const Standing& standing, const StandOptions& options) {
  return standing_rows(standing.support, options.pose, options.robust ? RowKind::robust : RowKind::nominal);
}

struct CarvedShell {
  Carving carving;
  std::optional<Shell> shell;
};

/// Carves and builds the shell; where simplifying it cost more than was aimed beyond, carves again for as much more.
Result<CarvedShell> carve_shell(const SolidVolume& volume, const Input& input, const BalanceProblem& problem,
                                const StandOptions& options, StageClock& clock, const Job& job) {
  double aimed_rad = options.pose.required_tip_rad + aimed_beyond_rad;
  for (int round = 1;; ++round) {
    const CarveOptions carving_options{options.aim, std::tan(aimed_rad), options.least_volume_mm3};
    auto carving = carve(volume, input.moments, problem, carving_options, job.part(0, 0.3));
    if (!carving) return tl::unexpected(carving.error());
    clock.lap("carve");
    carving->reaches = carving->t >= std::tan(options.pose.required_tip_rad);
    if (!carving->reaches && !options.best_effort) return CarvedShell{std::move(*carving), std::nullopt};
    auto shell = build_shell(input.solid, carving->field, {.wall_mm = options.wall_mm}, job.part(0.3, 1));
    if (!shell) return tl::unexpected(shell.error());
    clock.lap("shell");
    const double tip_rad = std::atan(largest_t(problem, moments(shell->mesh)));
    const double short_rad = options.pose.required_tip_rad - tip_rad;
    if (short_rad <= 0 || !carving->reaches || options.aim == CarveAim::stable || round == most_carvings)
      return CarvedShell{std::move(*carving), std::move(*shell)};
    aimed_rad += short_rad + aimed_beyond_rad;
  }
}

/// How far half the wall would go, on a coarse grid.
std::optional<double> tip_with_half_wall(const Input& input, const BalanceProblem& problem, const StandOptions& options,
                                         const Job& job) {
  VolumeOptions coarse{options.wall_mm / 2, options.wall_mm / 4, 0, options.memory_bytes};
  const auto volume = voxelize(input.solid, coarse, job.part(0, 0.7));
  if (!volume) return std::nullopt;
  const auto bound_t = carving_bound(*volume, input.moments, problem, 1e-4, job.part(0.7, 1));
  return bound_t ? std::optional(std::atan(*bound_t)) : std::nullopt;
}

void add_remedies(Report& report, const Input& input, const BalanceProblem& problem, const StandOptions& options,
                  const Standing& best, const Job& job) {
  if (const auto tip_rad = tip_with_half_wall(input, problem, options, job))
    report.hints.push_back(
        fmt::format("with a wall of {:.3g} mm, or printed twice as high with the wall as it is, carving "
                    "could reach about {:.1f} degrees",
                    options.wall_mm / 2, *tip_rad / degree));
  if (best.pedestal)
    report.hints.push_back(fmt::format("on a round pedestal {:.3g} mm across and {:.3g} mm thick it would stand",
                                       2 * best.pedestal->radius_mm, best.pedestal->thickness_mm));
  report.hints.push_back(
      "a wider base, or a pose that leans less, would help; bending the surface is not in this version");
}

}  // namespace

Result<Input> load_solid(const std::filesystem::path& path, const InputOptions& options, const Job& job,
                         const StageViewer& view) {
  StageSeconds seconds;
  StageClock clock(seconds);
  const auto file = read_mesh(path, options.read, job.part(0, 0.3));
  if (!file) return tl::unexpected(file.error());
  std::string several;
  const auto print = choose_print(*file, options.object, several);
  if (!print) return tl::unexpected(print.error());
  if (view) view("1-read", *print);
  clock.lap("read");
  const auto placed = place(*print, with_file_unit(options.placement, *file));
  if (!placed) return tl::unexpected(placed.error());
  if (view) view("2-placed", placed->mesh);
  auto repaired = repair(placed->mesh, options.repair, job.part(0.3, 1));
  if (!repaired) return tl::unexpected(repaired.error());
  if (!several.empty() && split_prints(repaired->solid.mesh()).size() > 1)
    return fail(ErrorCode::unusable_input, std::move(several));
  if (view) view("3-solid", repaired->solid.mesh());
  clock.lap("repair");
  Input input{repaired->solid, repaired->solid.moments(), std::move(repaired->report), file->notes, seconds};
  if (!options.placement.up)
    if (const auto hint = resting_hint(input.solid.mesh(), input.moments, {})) input.notes.push_back(to_text(*hint));
  return input;
}

std::string find_problem(const StandOptions& o) {
  if (std::string problem = find_problem(o.pose); !problem.empty()) return problem;
  if (!(o.density_g_per_cm3 > 0 && o.density_g_per_cm3 < 30))
    return fmt::format("density_g_per_cm3 is {}; it must lie in (0, 30)", o.density_g_per_cm3);
  if (!(o.wall_mm > 0 && o.wall_mm <= 1e4)) return fmt::format("wall_mm is {}; it must lie in (0, 10000]", o.wall_mm);
  if (o.voxel_mm)
    if (std::string problem = find_problem(VolumeOptions{o.wall_mm, *o.voxel_mm, o.least_void_mm, o.memory_bytes});
        !problem.empty())
      return problem;
  return find_problem(CarveOptions{o.aim, 0, o.least_volume_mm3});
}

double voxel_mm(const StandOptions& options, const Box3& box) {
  return options.voxel_mm.value_or(std::min(options.wall_mm / 4, box.diagonal() / 256));
}

Result<StandRun> stand(const Input& input, const StandOptions& options, const Job& job, const StageViewer& view) {
  assert(find_problem(options).empty());
  const auto before = standing_of(input.solid.mesh(), input.moments, options);
  if (!before) return tl::unexpected(before.error());
  StandRun run{std::nullopt, std::nullopt, begin_report(input, options, *before)};
  Report& report = run.report;
  StageClock clock(report.stage_seconds);
  const bool stands = asked_tip_rad(*before, options) >= options.pose.required_tip_rad;
  if (stands && options.aim == CarveAim::least) {
    report.outcome = Outcome::already_stands;
    run.shell = Shell{input.solid.mesh(), input.solid.mesh().triangles.size(), 0, 0, 0};
    return run;
  }

  const double voxel = voxel_mm(options, input.solid.box());
  const auto volume =
      voxelize(input.solid, {options.wall_mm, voxel, std::min(options.least_void_mm, 32 * voxel), options.memory_bytes},
               job.part(0, 0.4));
  if (!volume) return tl::unexpected(volume.error());
  clock.lap("voxelize");

  const BalanceProblem problem = rows_of(*before, options);
  auto carved = carve_shell(*volume, input, problem, options, clock, job.part(0.4, 0.9));
  if (!carved) return tl::unexpected(carved.error());
  run.shell = std::move(carved->shell);
  run.carving = std::move(carved->carving);
  if (view && run.shell) view("4-shell", run.shell->mesh);

  const Carving& carving = *run.carving;
  const auto after = standing_of(input.solid.mesh(), carving.body, options);
  if (!after) return tl::unexpected(after.error());
  report.after = *after;
  report.outcome = carving.reaches ? Outcome::stands : Outcome::best_effort;
  constexpr std::array<const char*, 3> aims{"least", "light", "stable"};
  report.carving =
      CarvingFigures{aims[static_cast<int>(options.aim)], input.moments.volume_mm3 - carving.body.volume_mm3,
                     std::atan(carving.bound_t), std::atan(carving.bound_t) - std::atan(carving.t),
                     static_cast<std::size_t>(carving.planes)};
  if (run.shell) report.wall = WallFigures{options.wall_mm, run.shell->wall_mm};
  if (!carving.reaches) {
    clock.lap("measure");
    add_remedies(report, input, problem, options, *after, job.part(0.9, 1));
    clock.lap("advise");
  }
  return run;
}

Result<Report> check(const Input& input, const StandOptions& options, const Job& job) {
  assert(find_problem(options).empty());
  if (!job.report(0, "check")) return cancelled();
  const auto before = standing_of(input.solid.mesh(), input.moments, options);
  if (!before) return tl::unexpected(before.error());
  Report report = begin_report(input, options, *before);
  const bool stands = asked_tip_rad(*before, options) >= options.pose.required_tip_rad;
  report.outcome = stands ? Outcome::already_stands : Outcome::falls;
  return report;
}

Result<Report> measure_output(const TriangleMesh& written, const StandRun& run, const StandOptions& options,
                              const Job& job) {
  assert(run.shell);
  if (!(written.triangles.size() == run.shell->mesh.triangles.size()))
    return fail(ErrorCode::internal, fmt::format("the file holds {} triangles instead of {}", written.triangles.size(),
                                                 run.shell->mesh.triangles.size()));
  const auto solid = check_solid(written, job);
  if (!solid) return tl::unexpected(solid.error());
  Report report = run.report;
  MeshFigures figures = report.mesh.value_or(MeshFigures{});
  figures.closed = solid->defects.open_edges == 0;
  figures.self_intersections = solid->defects.self_intersections;
  figures.triangles = written.triangles.size();
  for (std::size_t i = 0; i < run.shell->outer_triangles && figures.outer_unchanged; ++i)
    for (int corner = 0; corner < 3; ++corner)
      figures.outer_unchanged &= written.vertices[written.triangles[i][corner]] ==
                                 run.shell->mesh.vertices[run.shell->mesh.triangles[i][corner]];
  if (!solid->solid) return fail(ErrorCode::internal, "the shell is no solid: " + describe(solid->defects));
  figures.voids = solid->solid->voids();
  report.mesh = figures;
  const auto after = standing_of(written, solid->solid->moments(), options);
  if (!after) return tl::unexpected(after.error());
  report.after = *after;
  if (report.carving) {
    const double tip_rad = asked_tip_rad(*after, options);
    report.carving->gap_rad = report.carving->bound_rad - tip_rad;
    report.outcome = tip_rad >= options.pose.required_tip_rad ? Outcome::stands : Outcome::best_effort;
  }
  return report;
}

}  // namespace aplomb
