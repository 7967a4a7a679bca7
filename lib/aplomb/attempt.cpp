#include "aplomb/attempt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "aplomb/ceilings.h"
#include "aplomb/drained.h"
#include "aplomb/fdm/predict_print.h"
#include "aplomb/inserted.h"
#include "aplomb/printability/printed_solid.h"

namespace aplomb {
namespace {

constexpr double aimed_beyond_rad = 0.004 * std::numbers::pi / 180;  // what simplifying the shell may cost
constexpr int most_carvings = 3, most_sliced_carvings = 6;
constexpr double bent_beyond_rad =
    0.03 * std::numbers::pi / 180;          // beyond what a bend came short of: carving keeps more
constexpr double bent_beyond_ratio = 1.15;  // and what ribs under the ceilings of a larger void cost
constexpr int most_bends = 3;
constexpr int most_reshapings = most_bends + 1;  // the first may be a cut alone

DeformationFigures figures_of(const Reshaper& reshaper, const Reshaping& reshaping) {
  constexpr std::array<const char*, 3> outcomes{"reached", "limit", "stuck"};
  DeformationFigures figures;
  figures.outcome = "trimmed";
  figures.trim_mm = reshaping.trim_mm;
  for (const TrimGain& gain : reshaper.gains()) figures.trims.push_back({gain.trim_mm, std::atan(gain.t)});
  if (!reshaping.bent) return figures;
  const CageDeformation& cage = reshaping.bent->cage;
  const bool stopped = reshaping.bent->path_ratio < 1;  // the surface would have crossed itself
  figures.outcome = stopped ? "stuck" : outcomes[static_cast<std::size_t>(cage.outcome)];
  figures.mean_mm = reshaping.bent->path_ratio * cage.mean_mm;
  figures.max_mm = reshaping.bent->max_mm;
  figures.handle_short_mm = reshaping.bent->handle_short_mm;
  figures.max_turn_rad = cage.max_turn_rad;
  figures.iterations = cage.iterations;
  figures.energy_mm3 = cage.energy_mm3;
  return figures;
}

/// The same input with another solid.
Input with_solid(Input input, const SolidMesh& solid) {
  input.solid = solid;
  input.moments = solid.moments();
  return input;
}

/// What a shell weighs and where: as it is sliced, or as one piece.
Result<Moments> printed_moments(const TriangleMesh& shell, const StandOptions& options, const Job& job) {
  if (!options.profile) return moments(shell);
  const auto solid = check_solid(shell, job.part(0, 0.5));
  if (!solid) return tl::unexpected(solid.error());
  if (!solid->solid) return fail(ErrorCode::internal, "the shell is no solid: " + describe(solid->defects));
  const auto print = predict_print(printed_solid(*solid->solid), *options.profile, job.part(0.5, 1));
  if (!print) return tl::unexpected(print.error());
  return print->all();
}

/// Of one material alone density errors move nothing.
RowKind loaded_kind(const Input& input, const StandOptions& options) {
  return input.inserts.empty() ? RowKind::nominal : kind_of(options);
}

/// How far short of its angle a reshaped solid ends; infinitely where a thread hangs slack.
double shortfall_t(const ReshapedAttempt& reshaped, const JointProblem& joint) {
  Moments body = reshaped.input.moments;
  if (reshaped.attempt) body = reshaped.attempt->carving.body;
  if (reshaped.attempt && reshaped.attempt->shell) body = moments(reshaped.attempt->shell->mesh);
  return joint.required_t - largest_t(joint.problem, body);
}

/// A shell whose voids print: ceilings first, for the holes go where the void then is.
Result<Attempt> with_printable_voids(Attempt made, const Input& input, const StandOptions& options, StageClock& clock,
                                     const Job& job) {
  if (shapes_ceilings(options)) {
    const CarveAgain carve_again = [&](const SolidVolume& allowed, const Job& part) {
      clock.lap("ceilings");
      return carve_shell(allowed, input, made.joint, options, {{}, aimed_beyond_rad, true}, clock, part);
    };
    auto shaped = with_printable_ceilings(made, options.judge.rules, carve_again, job.part(0, 0.5));
    if (!shaped) return shaped;
    made = std::move(*shaped);
    clock.lap("ceilings");
  }
  if (!hole_demand(options)) return made;
  return drained(std::move(made), input, options, clock, job.part(0.5, 1));
}

}  // namespace

Result<Attempt> carve_shell(const SolidVolume& volume, const Input& input, const JointProblem& joint,
                            const StandOptions& options, const CarvingAllowance& allowance, StageClock& clock,
                            const Job& job) {
  const double required_rad = std::atan(joint.required_t);
  const int most_rounds = options.profile ? most_sliced_carvings : most_carvings;
  const Moments inserts = inserts_as_solid(input.inserts, options);
  double aimed_rad = required_rad + allowance.beyond_rad;
  for (int round = 1;; ++round) {
    const CarveOptions carving_options{options.aim, std::tan(aimed_rad), options.least_volume_mm3};
    auto carving =
        carve(volume, input.moments - allowance.taken + inserts, joint.problem, carving_options, job.part(0, 0.3));
    if (!carving) return tl::unexpected(carving.error());
    carving->body = carving->body - inserts;
    clock.lap("carve");
    carving->reaches = carving->t >= joint.required_t;
    if (!carving->reaches && !allowance.always) return Attempt{joint, std::move(*carving), std::nullopt, volume};
    auto shell = build_shell(input.solid, carving->field, {.wall_mm = options.wall_mm}, job.part(0.3, 0.9));
    if (!shell) return tl::unexpected(shell.error());
    clock.lap("shell");
    const auto body = printed_moments(shell->mesh, options, job.part(0.9, 1));
    if (!body) return tl::unexpected(body.error());
    const LoadedBody loaded{*body - allowance.taken, inserts};
    const double short_rad = required_rad - std::atan(loaded_t(joint.problem, loaded, loaded_kind(input, options)));
    const bool has_more = aimed_rad < std::atan(carving->bound_t);  // else this was the most stable void
    if (short_rad <= 0 || !carving->reaches || !has_more || options.aim == CarveAim::stable || round == most_rounds) {
      if (options.profile) carving->reaches &= short_rad <= 0 || options.aim == CarveAim::stable;
      return Attempt{joint, std::move(*carving), std::move(*shell), volume};
    }
    aimed_rad += short_rad + aimed_beyond_rad;
  }
}

Result<Attempt> attempt_carving(const Input& input, const StandOptions& asked, StageClock& clock, const Job& job) {
  const StandOptions options = with_voids_for_holes(asked);
  const double voxel = voxel_mm(options, input.solid.box());
  const auto volume =
      voxelize(input.solid, {options.wall_mm, voxel, std::min(options.least_void_mm, 32 * voxel), options.memory_bytes},
               job.part(0, 0.4));
  if (!volume) return tl::unexpected(volume.error());
  clock.lap("voxelize");
  const auto joint = joint_problem(input.solid.mesh(), options.poses, kind_of(options));
  if (!joint) return tl::unexpected(joint.error());
  auto made = carve_shell(*volume, input, *joint, options, {{}, aimed_beyond_rad}, clock, job.part(0.4, 0.6));
  if (!made || !made->shell) return made;
  return with_printable_voids(std::move(*made), input, options, clock, job.part(0.6, 1));
}

Result<void> add_shell(Attempt& attempt, const Input& input, const StandOptions& asked, StageClock& clock,
                       const Job& job) {
  const StandOptions options = with_voids_for_holes(asked);
  auto shell = build_shell(input.solid, attempt.carving.field, {.wall_mm = options.wall_mm}, job.part(0, 0.3));
  if (!shell) return tl::unexpected(shell.error());
  attempt.shell = std::move(*shell);
  clock.lap("shell");
  auto made = with_printable_voids(std::move(attempt), input, options, clock, job.part(0.3, 1));
  if (!made) return tl::unexpected(made.error());
  attempt = std::move(*made);
  return {};
}

Result<ReshapedAttempt> attempt_reshaping(const Input& input, const StandOptions& options, StageClock& clock,
                                          const Job& job) {
  ReshapeOptions reshaping_options = options.reshape;
  reshaping_options.wall_mm = options.wall_mm;
  reshaping_options.carves = options.deform != Deform::only;
  const auto reshaper =
      Reshaper::make(input.solid, options.poses, kind_of(options), reshaping_options, job.part(0, 0.2));
  if (!reshaper) return tl::unexpected(reshaper.error());
  double beyond_t = 0;
  int bends = 0;
  for (int round = 1;; ++round) {
    const Job part = job.part(0.2 + 0.8 * (round - 1) / most_reshapings, 0.2 + 0.8 * round / most_reshapings);
    const auto reshaping = reshaper->reshape(beyond_t, part.part(0, 0.4));
    if (!reshaping) return tl::unexpected(reshaping.error());
    clock.lap("deform");
    ReshapedAttempt made{with_solid(input, reshaping->solid), figures_of(*reshaper, *reshaping), std::nullopt};
    made.figures.volume_change_ratio = made.input.moments.volume_mm3 / input.moments.volume_mm3 - 1;
    if (reshaping_options.carves) {
      auto attempt = attempt_carving(made.input, options, clock, part.part(0.4, 1));
      if (!attempt) return tl::unexpected(attempt.error());
      made.attempt = std::move(*attempt);
    }
    const auto joint = joint_problem(made.input.solid.mesh(), options.poses, kind_of(options));
    if (!joint) return tl::unexpected(joint.error());
    const double short_t = shortfall_t(made, *joint);
    const bool at_limit = made.figures.outcome == "limit" || made.figures.outcome == "stuck";
    if (reshaping->bent) ++bends;
    if (short_t <= 0 || at_limit || bends == most_bends) return made;
    const double told_t = std::isfinite(short_t) ? short_t : 0;
    beyond_t += bent_beyond_ratio * told_t + std::tan(bent_beyond_rad);
  }
}

}  // namespace aplomb
