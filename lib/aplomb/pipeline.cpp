#include "aplomb/pipeline.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "aplomb/attempt.h"
#include "aplomb/balance/attachments.h"
#include "aplomb/balance/resting.h"
#include "aplomb/mesh/bodies.h"
#include "aplomb/report/text.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;

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

Result<std::vector<PoseMeasure>> measure_poses(const TriangleMesh& outer, const Moments& body,
                                               const StandOptions& options) {
  std::vector<PoseMeasure> measures;
  for (const Pose& pose : options.poses) {
    auto measure = measure_pose(outer, uniform_body(body, options), pose);
    if (!measure) return tl::unexpected(measure.error());
    measures.push_back(std::move(*measure));
  }
  return measures;
}

void note_loose_attachments(const TriangleMesh& mesh, const std::vector<Pose>& poses, std::vector<std::string>& notes) {
  for (const Pose& pose : poses)
    if (const HangingPose* hanging = pose.hanging())
      for (const auto& [at, distance] : loose_attachments(mesh, *hanging))
        notes.push_back(fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) mm to hang from is {:.3g} mm off the model",
                                    at.x, at.y, at.z, distance));
}

/// The report of the solid as it came.
Result<Report> begin_report(const Input& input, const StandOptions& options) {
  auto before = measure_poses(input.solid.mesh(), input.moments, options);
  if (!before) return tl::unexpected(before.error());
  Report report;
  report.version = APLOMB_VERSION;
  for (const Pose& pose : options.poses) report.poses.push_back({pose, {}, {}, false});
  set_before(report, std::move(*before), kind_of(options));
  report.repair = input.repair.steps;
  report.hints = input.notes;
  note_loose_attachments(input.solid.mesh(), options.poses, report.hints);
  report.stage_seconds = input.stage_seconds;
  report.mesh =
      MeshFigures{input.repair.outer_unchanged, true, 0, input.solid.voids(), input.solid.mesh().triangles.size()};
  return report;
}

CarvingFigures carving_figures(const Carving& carving, const Input& input, const JointProblem& joint,
                               const StandOptions& options) {
  constexpr std::array<const char*, 3> aims{"least", "light", "stable"};
  const bool hangs = !joint.is_surplus && options.poses.front().hanging();
  const double bound_rad = std::atan(carving.bound_t);
  return {aims[static_cast<int>(options.aim)],
          input.moments.volume_mm3 - carving.body.volume_mm3,
          hangs ? -bound_rad : bound_rad,
          bound_rad - std::atan(carving.t),
          static_cast<std::size_t>(carving.planes),
          joint.is_surplus ? BoundOf::surplus : (hangs ? BoundOf::tilt : BoundOf::tip)};
}

/// How far half the wall would go, on a coarse grid: the bound of t.
std::optional<double> t_with_half_wall(const Input& input, const JointProblem& joint, const StandOptions& options,
                                       const Job& job) {
  VolumeOptions coarse{options.wall_mm / 2, options.wall_mm / 4, 0, options.memory_bytes};
  const auto volume = voxelize(input.solid, coarse, job.part(0, 0.7));
  if (!volume) return std::nullopt;
  const auto bound_t = carving_bound(*volume, input.moments, joint.problem, 1e-4, job.part(0.7, 1));
  return bound_t ? std::optional(*bound_t) : std::nullopt;
}

std::string half_wall_text(double t, const JointProblem& joint, const StandOptions& options) {
  const double angle_deg = std::atan(t) / degree;
  if (joint.is_surplus) return t >= 0 ? "meet every pose" : "still not meet every pose";
  if (options.poses.front().hanging()) return fmt::format("come to about {:.1f} degrees from level", -angle_deg);
  return fmt::format("reach about {:.1f} degrees", angle_deg);
}

void add_remedies(Report& report, const Input& input, const JointProblem& joint, const StandOptions& options,
                  const Job& job) {
  if (const auto t = t_with_half_wall(input, joint, options, job))
    report.hints.push_back(
        fmt::format("with a wall of {:.3g} mm, or printed twice as high with the wall as it is, carving could {}",
                    options.wall_mm / 2, half_wall_text(*t, joint, options)));
  if (report.after && report.after->pedestal)
    report.hints.push_back(fmt::format("on a round pedestal {:.3g} mm across and {:.3g} mm thick it would stand",
                                       2 * report.after->pedestal->radius_mm, report.after->pedestal->thickness_mm));
  report.hints.push_back(report.has_standing_pose()
                             ? "a wider base, or a pose that leans less, would help"
                             : "another point to hang from, nearer to straight above the centre of mass, would help");
  if (options.deform == Deform::never) report.hints.push_back("bending the surface a little would help: --deform auto");
  else if (report.deformation && report.deformation->outcome == "limit")
    report.hints.push_back("a larger --deform-limit or --trim-base would allow more");
}

/// The judge sees the print as it lies on the plate.
JudgeOptions judge_options(const StandOptions& options) {
  JudgeOptions judging = options.judge;
  judging.pose.reset();
  judging.density_g_per_cm3 = options.density_g_per_cm3;
  for (const Pose& pose : options.poses)
    if (const StandingPose* standing = pose.standing(); standing && !judging.pose && standing->up == Vec3{0, 0, 1})
      judging.pose = *standing;
  return judging;
}

/// Says of a run what was made: of the solid alone where nothing was carved.
Result<StandRun> finish(StandRun run, const Input& shaped, std::optional<Attempt> made, const StandOptions& options,
                        StageClock& clock, const Job& job, const StageViewer& view) {
  Report& report = run.report;
  if (made) {
    report.carving = carving_figures(made->carving, shaped, made->joint, options);
    run.shell = std::move(made->shell);
    run.carving = std::move(made->carving);
  } else {
    run.shell = Shell{shaped.solid.mesh(), shaped.solid.mesh().triangles.size(), 0, 0, 0};
  }
  if (view && run.shell) view("5-shell", run.shell->mesh);
  auto after = measure_poses(shaped.solid.mesh(), run.carving ? run.carving->body : shaped.moments, options);
  if (!after) return tl::unexpected(after.error());
  set_after(report, std::move(*after), kind_of(options));
  const bool reaches = run.carving ? run.carving->reaches : all_hold(report);
  report.outcome = reaches ? Outcome::stands : Outcome::best_effort;
  if (run.shell && run.carving) report.wall = WallFigures{options.wall_mm, run.shell->wall_mm};
  if (!reaches && made) {
    clock.lap("measure");
    add_remedies(report, shaped, made->joint, options, job);
    clock.lap("advise");
  }
  return run;
}

}  // namespace

Result<TriangleMesh> load_print(const std::filesystem::path& path, const InputOptions& options, const Job& job) {
  const auto file = read_mesh(path, options.read, job);
  if (!file) return tl::unexpected(file.error());
  std::string several;
  const auto print = choose_print(*file, options.object, several);
  if (!print) return tl::unexpected(print.error());
  return place(*print, with_file_unit(options.placement, *file)).map([](Placed placed) {
    return std::move(placed.mesh);
  });
}

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
  if (!options.placement.up && options.hint_at_resting)
    if (const auto hint = resting_hint(input.solid.mesh(), input.moments, {})) input.notes.push_back(to_text(*hint));
  return input;
}

std::string find_problem(const StandOptions& o) {
  if (std::string problem = find_problem(o.poses); !problem.empty()) return problem;
  if (!(o.density_g_per_cm3 > 0 && o.density_g_per_cm3 < 30))
    return fmt::format("density_g_per_cm3 is {}; it must lie in (0, 30)", o.density_g_per_cm3);
  if (!(o.wall_mm > 0 && o.wall_mm <= 1e4)) return fmt::format("wall_mm is {}; it must lie in (0, 10000]", o.wall_mm);
  if (o.voxel_mm)
    if (std::string problem = find_problem(VolumeOptions{o.wall_mm, *o.voxel_mm, o.least_void_mm, o.memory_bytes});
        !problem.empty())
      return problem;
  if (std::string problem = find_problem(o.reshape); !problem.empty()) return problem;
  if (o.deform == Deform::never && !o.reshape.regions.handles.empty())
    return "deform is never, but a handle moves the outside; it must be auto or only";
  if (std::string problem = find_problem(o.judge); !problem.empty()) return problem;
  return find_problem(CarveOptions{o.aim, 0, o.least_volume_mm3});
}

double voxel_mm(const StandOptions& options, const Box3& box) {
  return options.voxel_mm.value_or(std::min(options.wall_mm / 4, box.diagonal() / 256));
}

Result<StandRun> stand(const Input& input, const StandOptions& options, const Job& job, const StageViewer& view) {
  assert(find_problem(options).empty());
  auto begun = begin_report(input, options);
  if (!begun) return tl::unexpected(begun.error());
  StandRun run{std::nullopt, std::nullopt, std::move(*begun)};
  Report& report = run.report;
  StageClock clock(report.stage_seconds);
  const bool is_to_move = !options.reshape.regions.handles.empty();
  if (all_hold(report) && !is_to_move && options.aim == CarveAim::least) {
    report.outcome = Outcome::already_stands;
    run.shell = Shell{input.solid.mesh(), input.solid.mesh().triangles.size(), 0, 0, 0};
    return run;
  }

  Input shaped = input;
  std::optional<Attempt> made;
  if (options.deform != Deform::only && !is_to_move) {
    auto carved = attempt_carving(input, options, clock, job.part(0, options.deform == Deform::never ? 0.8 : 0.4));
    if (!carved) return tl::unexpected(carved.error());
    made = std::move(*carved);
  }
  if (options.deform != Deform::never && !(made && made->carving.reaches)) {
    auto reshaped = attempt_reshaping(input, options, clock, job.part(0.4, 0.8));
    if (!reshaped) return tl::unexpected(reshaped.error());
    shaped = std::move(reshaped->input);
    made = std::move(reshaped->attempt);
    report.deformation = std::move(reshaped->figures);
    report.mesh->outer_unchanged = false;
    if (view) view("4-reshaped", shaped.solid.mesh());
  }
  if (made && !made->shell && options.best_effort)
    if (const auto shell = add_shell(*made, shaped, options, clock, job.part(0.8, 0.9)); !shell)
      return tl::unexpected(shell.error());
  return finish(std::move(run), shaped, std::move(made), options, clock, job.part(0.9, 1), view);
}

Result<Report> check(const Input& input, const StandOptions& options, const Job& job) {
  assert(find_problem(options).empty());
  if (!job.report(0, "check")) return cancelled();
  auto report = begin_report(input, options);
  if (report) report->outcome = all_hold(*report) ? Outcome::already_stands : Outcome::falls;
  return report;
}

Result<Report> measure_output(const TriangleMesh& written, const StandRun& run, const StandOptions& options,
                              const Job& job) {
  assert(run.shell);
  if (!(written.triangles.size() == run.shell->mesh.triangles.size()))
    return fail(ErrorCode::internal, fmt::format("the file holds {} triangles instead of {}", written.triangles.size(),
                                                 run.shell->mesh.triangles.size()));
  const auto solid = check_solid(written, job.part(0, 0.4));
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
  auto after = measure_poses(written, solid->solid->moments(), options);
  if (!after) return tl::unexpected(after.error());
  set_after(report, std::move(*after), kind_of(options));
  auto judgement = judge(written, judge_options(options), &run.shell->mesh, job.part(0.4, 1));
  if (!judgement) return tl::unexpected(judgement.error());
  report.judgement = std::move(*judgement);
  if (report.carving || report.deformation) report.outcome = all_hold(report) ? Outcome::stands : Outcome::best_effort;
  return report;
}

}  // namespace aplomb
