#include "aplomb/pipeline.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "aplomb/advice.h"
#include "aplomb/attempt.h"
#include "aplomb/ballasted.h"
#include "aplomb/holes/drill.h"
#include "aplomb/inserted.h"

namespace aplomb {
namespace {

std::vector<Region> uniform_body(const Moments& body, const StandOptions& options) {
  return {Region{body, options.density_g_per_cm3, 0.02}};
}

Shell as_it_came(const Input& input) { return {input.solid.mesh(), input.solid.mesh().triangles.size(), 0, 0, 0}; }

std::vector<Region> with_regions(std::vector<Region> body, const std::vector<Region>& more) {
  body.insert(body.end(), more.begin(), more.end());
  return body;
}

Result<std::vector<PoseMeasure>> measure_poses(const TriangleMesh& outer, const std::vector<Region>& body,
                                               const StandOptions& options) {
  std::vector<PoseMeasure> measures;
  for (const Pose& pose : options.poses) {
    auto measure = measure_pose(outer, body, pose);
    if (!measure) return tl::unexpected(measure.error());
    measures.push_back(std::move(*measure));
  }
  return measures;
}

/// The report of the solid as it came.
Result<Report> begin_report(const Input& input, const std::optional<LayeredPrint>& layers, const StandOptions& options,
                            const Job& job) {
  const auto body = layers ? body_of(input.solid, layers, options, std::nullopt, job)
                           : uniform_body(input.moments, options);  // of triangles that cross: as repair left them
  if (!body) return tl::unexpected(body.error());
  auto before = measure_poses(input.solid.mesh(), *body, options);
  if (!before) return tl::unexpected(before.error());
  Report report;
  report.version = APLOMB_VERSION;
  for (const Pose& pose : options.poses) report.poses.push_back({pose, {}, {}, false});
  set_before(report, std::move(*before), kind_of(options));
  report.repair = input.repair.steps;
  report.hints = input.notes;
  note_loose_attachments(report, input.solid.mesh());
  report.stage_seconds = input.stage_seconds;
  report.mesh =
      MeshFigures{input.repair.outer_unchanged, true, 0, input.solid.voids(), input.solid.mesh().triangles.size()};
  return report;
}

CarvingFigures carving_figures(const Carving& carving, const Input& input, const JointProblem& joint,
                               const StandOptions& options) {
  constexpr std::array<const char*, 3> aims{"least", "light", "stable"};
  const double bound_rad = joint.bound_rad(carving.bound_t);
  return {aims[static_cast<int>(options.aim)],
          input.moments.volume_mm3 - carving.body.volume_mm3,
          bound_rad,
          std::abs(bound_rad - joint.angle_rad(carving.t)),
          static_cast<std::size_t>(carving.planes),
          joint.bound_of,
          {}};
}

/// Says of a run that mass is moved by infill; the solid leaves as it came.
Result<StandRun> finish_ballast(StandRun run, const Input& input, const Ballast& ballast, const JointProblem& joint,
                                const StandOptions& options) {
  Report& report = run.report;
  report.ballast = ballast_figures(ballast, joint, options);
  auto after = measure_poses(input.solid.mesh(), printed_body(ballast.print, options), options);
  if (!after) return tl::unexpected(after.error());
  set_after(report, std::move(*after), kind_of(options));
  report.outcome = ballast.reaches ? Outcome::stands : Outcome::best_effort;
  if (options.ballast == Ballasting::automatic)
    report.hints.push_back(
        fmt::format("balanced by infill, for at {:.3g} % a void would first add mass: the slicer puts skins round it; "
                    "--no-ballast carves all the same",
                    100 * report.ballast->low_ratio));
  run.shell = as_it_came(input);
  run.ballast = ballast;
  return run;
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

/// Between a finding about the shell and one about the model as it came; more where it was bent.
constexpr double same_place_mm = 2;

bool is_changed(const StandRun& run) { return run.carving || run.report.deformation || run.report.inserts; }

/// Judges what was written, as the body that is printed; where it fails, the model as it came too, to tell what carving
/// did from what was there.
Result<Judgement> judge_output(const TriangleMesh& written, std::vector<Region> body, const Input& input,
                               const StandRun& run, const StandOptions& options, const Job& job) {
  JudgeOptions judging = judge_options(options);
  judging.body = std::move(body);
  judging.inserts = run.inserts;
  auto judgement = judge(written, judging, &run.shell->mesh, job.part(0, 0.5));
  if (!judgement || judgement->new_failures().empty()) return judgement;
  judging.inserts.clear();
  auto came = body_of(input.solid, run.layers, options, std::nullopt, job.part(0.5, 0.55));
  if (!came) return tl::unexpected(came.error());
  judging.body = std::move(*came);
  const auto before = is_changed(run) ? judge(input.solid.mesh(), judging, nullptr, job.part(0.55, 1)) : judgement;
  if (!before) return tl::unexpected(before.error());
  const double moved_mm = run.report.deformation ? run.report.deformation->max_mm : 0;
  mark_inherited(*judgement, *before, same_place_mm + moved_mm);
  return judgement;
}

/// Tells of the holes that were cut.
void take_holes(StandRun& run, const Input& shaped, const Attempt& made) {
  run.report.hints.insert(run.report.hints.end(), made.hints.begin(), made.hints.end());
  run.holes = made.holes;
  for (const Hole& hole : made.holes)
    run.report.holes.push_back(
        {hole.at(hole.mouth_mm), hole.at(hole.throat_mm), hole.outward, hole.bore_mm, hole.wall_mm()});
  if (made.holes.empty()) return;
  run.undrilled = shaped.solid.mesh();
  run.report.mesh->outer_unchanged = false;
}

/// Puts inserts in, and says so.
Result<Inserted> put_in(StandRun& run, const Input& input, const StandOptions& options, StageClock& clock,
                        const Job& job, const StageViewer& view) {
  auto inserted = with_inserts(input, options, clock, job);
  if (!inserted) return inserted;
  if (view) view("3-pockets", inserted->input.solid.mesh());
  run.inserts = inserted->input.inserts;
  run.report.inserts = inserted->figures;
  if (!run.inserts.empty()) run.report.wall = WallFigures{options.wall_mm, inserted->wall_mm};
  return inserted;
}

/// Says of a run what was made: of the solid alone where nothing was carved.
Result<StandRun> finish(StandRun run, const Input& shaped, std::optional<Attempt> made, const StandOptions& options,
                        StageClock& clock, const Job& job, const StageViewer& view) {
  Report& report = run.report;
  if (made) {
    report.carving = carving_figures(made->carving, shaped, made->joint, options);
    report.carving->ceiling = made->ceiling;
    add_ceiling_hints(report, made->carving.reaches);
    run.shell = std::move(made->shell);
    take_holes(run, shaped, *made);
    run.carving = std::move(made->carving);
  } else {
    run.shell = as_it_came(shaped);
  }
  if (view && run.shell) view("5-shell", run.shell->mesh);
  const Moments& kept = run.carving ? run.carving->body : shaped.moments;
  auto after = measure_poses(shaped.solid.mesh(), with_regions(uniform_body(kept, options), shaped.inserts), options);
  if (!after) return tl::unexpected(after.error());
  set_after(report, std::move(*after), kind_of(options));
  const bool reaches = run.carving ? run.carving->reaches : all_hold(report);
  report.outcome = reaches ? Outcome::stands : Outcome::best_effort;
  if (run.shell && run.carving) {
    const double pockets_mm = report.wall ? report.wall->measured_mm : std::numeric_limits<double>::infinity();
    report.wall = WallFigures{options.wall_mm, std::min(run.shell->wall_mm, pockets_mm)};
  }
  if (!reaches && made) {
    clock.lap("measure");
    if (const auto advised = add_advice(report, shaped, made->joint, options, job); !advised)
      return tl::unexpected(advised.error());
    clock.lap("advise");
  }
  return run;
}

/// A run on what stands by itself.
StandRun left_as_it_is(StandRun run, const Input& input, const StandOptions& options) {
  run.report.outcome = Outcome::already_stands;
  if (!options.inserts.empty()) run.report.hints.emplace_back("it stands by itself: no insert was put in");
  run.shell = as_it_came(input);
  return run;
}

}  // namespace

Result<StandRun> stand(const Input& input, const StandOptions& options, const Job& job, const StageViewer& view) {
  assert(find_problem(options).empty());
  auto layers = layers_of(input.solid, options, job.part(0, 0.04));
  if (!layers) return tl::unexpected(layers.error());
  auto begun = begin_report(input, *layers, options, job.part(0.04, 0.05));
  if (!begun) return tl::unexpected(begun.error());
  StandRun run;
  run.layers = std::move(*layers);
  run.report = std::move(*begun);
  Report& report = run.report;
  StageClock clock(report.stage_seconds);
  const bool is_to_move = !options.reshape.regions.handles.empty();
  if (all_hold(report) && !is_to_move && options.aim == CarveAim::least)
    return left_as_it_is(std::move(run), input, options);

  std::optional<Ballast> ballast;
  std::optional<JointProblem> joint;
  if (tries_ballast(options)) {
    auto posed = joint_problem(input.solid.mesh(), options.poses, kind_of(options));
    if (!posed) return tl::unexpected(posed.error());
    joint = std::move(*posed);
    auto tried = attempt_ballast(input, *run.layers, *joint, options, clock, job.part(0.05, 0.2));
    if (!tried) return tl::unexpected(tried.error());
    if (tried->reaches || options.ballast == Ballasting::only)
      return finish_ballast(std::move(run), input, *tried, *joint, options);
    ballast = *tried;
  }
  Input shaped = input;
  std::optional<Attempt> made;
  bool is_to_carve = options.deform != Deform::only && !is_to_move;
  if (!options.inserts.empty()) {
    auto inserted = put_in(run, input, options, clock, job.part(0.05, 0.2), view);
    if (!inserted) return tl::unexpected(inserted.error());
    is_to_carve = !inserted->reaches || options.aim != CarveAim::least;
    shaped = std::move(inserted->input);
  }
  if (is_to_carve) {
    const double from = 0.2;
    auto carved = attempt_carving(shaped, options, clock, job.part(from, options.deform == Deform::never ? 0.8 : 0.4));
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
  if (ballast && !report.deformation && !(made && made->carving.reaches))
    return finish_ballast(std::move(run), input, *ballast, *joint, options);
  if (made && !made->shell && options.best_effort)
    if (const auto shell = add_shell(*made, shaped, options, clock, job.part(0.8, 0.9)); !shell)
      return tl::unexpected(shell.error());
  return finish(std::move(run), shaped, std::move(made), options, clock, job.part(0.9, 1), view);
}

Result<std::vector<TriangleMesh>> hole_plugs(const StandRun& run, const Job& job) {
  return plugs(run.undrilled, run.holes, 0.15, job);
}

Result<Report> check(const Input& input, const StandOptions& options, const Job& job) {
  assert(find_problem(options).empty());
  if (!job.report(0, "check")) return cancelled();
  const auto layers = layers_of(input.solid, options, job.part(0, 0.9));
  if (!layers) return tl::unexpected(layers.error());
  auto report = begin_report(input, *layers, options, job.part(0.9, 1));
  if (report) report->outcome = all_hold(*report) ? Outcome::already_stands : Outcome::falls;
  return report;
}

Result<Report> measure_output(const TriangleMesh& written, const Input& input, const StandRun& run,
                              const StandOptions& options, const Job& job) {
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
  const bool is_as_it_came = !is_changed(run) && figures.outer_unchanged;
  const auto layers = is_as_it_came ? Result<std::optional<LayeredPrint>>(run.layers)
                                    : layers_of(*solid->solid, options, job.part(0.4, 0.48));
  if (!layers) return tl::unexpected(layers.error());
  const auto body = body_of(*solid->solid, *layers, options, run.ballast, job.part(0.48, 0.5));
  if (!body) return tl::unexpected(body.error());
  auto after = measure_poses(written, with_regions(*body, run.inserts), options);
  if (!after) return tl::unexpected(after.error());
  set_after(report, std::move(*after), kind_of(options));
  auto judgement = judge_output(written, *body, input, run, options, job.part(0.5, 1));
  if (!judgement) return tl::unexpected(judgement.error());
  report.judgement = std::move(*judgement);
  if (report.carving || report.deformation || report.ballast || report.inserts)
    report.outcome = all_hold(report) ? Outcome::stands : Outcome::best_effort;
  if (options.profile && report.carving) note_sliced(report);
  return report;
}

}  // namespace aplomb
