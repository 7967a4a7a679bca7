#include "aplomb/ballasted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace aplomb {
namespace {

constexpr int most_rounds = 4;
constexpr double beyond_t = 1e-4;      // asked for in addition to what the measured print came short of
constexpr double beside_model_mm = 1;  // so that no face of the volume lies on the model's surface

double mass_g(const PoseMeasure& measure) {
  if (const auto* standing = std::get_if<Standing>(&measure)) return standing->stability.mass_g;
  return std::get<Hanging>(measure).mass_g;
}

/// By how much the print falls short of the pose that it meets least; robust angles also reckon with uneven infill.
Result<double> shortfall_t(const Input& input, const Ballast& ballast, const StandOptions& options) {
  double least = std::numeric_limits<double>::infinity();
  for (const Pose& pose : options.poses) {
    const auto measure = measure_pose(input.solid.mesh(), printed_body(ballast.print, options), pose);
    if (!measure) return tl::unexpected(measure.error());
    least = std::min(least, surplus_t(pose, *measure, kind_of(options)));
  }
  return -least;
}

/// The layers with the low density where ballast is not.
Result<LayeredPrint> with_low_infill(const LayeredPrint& layers, const SolidMesh& solid, const StandOptions& options,
                                     const Job& job) {
  const PrintProfile low = profile_with_ballast(options);
  if (auto same = layers.with_infill(low.infill_ratio)) return std::move(*same);
  return LayeredPrint::make(printed_solid(solid), low, job);
}

}  // namespace

bool tries_ballast(const StandOptions& o) {
  if (o.ballast != Ballasting::automatic) return o.ballast == Ballasting::only;
  return o.profile && profile_with_ballast(o).infill_ratio >= least_ballast_ratio &&
         profile_with_ballast(o).infill_ratio < o.ballast_high_ratio && o.judge.rules.process() == Process::fdm &&
         o.aim != CarveAim::light && o.deform != Deform::only && o.reshape.regions.handles.empty() && o.inserts.empty();
}

PrintProfile profile_with_ballast(const StandOptions& options) {
  PrintProfile profile = *options.profile;
  profile.infill_ratio = options.ballast_low_ratio.value_or(profile.infill_ratio);
  return profile;
}

Result<std::optional<LayeredPrint>> layers_of(const SolidMesh& solid, const StandOptions& options, const Job& job) {
  if (!options.profile) return std::optional<LayeredPrint>();
  auto layers = LayeredPrint::make(printed_solid(solid), *options.profile, job);
  if (!layers) return tl::unexpected(layers.error());
  return std::optional(std::move(*layers));
}

Result<Ballast> attempt_ballast(const Input& input, const LayeredPrint& layers, const JointProblem& joint,
                                const StandOptions& options, StageClock& clock, const Job& job) {
  const auto print = with_low_infill(layers, input.solid, options, job.part(0, 0.5));
  if (!print) return tl::unexpected(print.error());
  BallastOptions asked{options.aim, joint.required_t, options.ballast_high_ratio};
  for (int round = 1;; ++round) {
    const Job part = job.part(0.5 + 0.5 * (round - 1) / most_rounds, 0.5 + 0.5 * round / most_rounds);
    auto ballast = choose_ballast(*print, joint.problem, asked, part);
    clock.lap("ballast");
    if (!ballast) return ballast;
    const auto short_t = shortfall_t(input, *ballast, options);
    if (!short_t) return tl::unexpected(short_t.error());
    ballast->reaches = *short_t <= 0;
    const bool has_more = asked.required_t < ballast->bound_t;
    if (ballast->reaches || !has_more || options.aim == CarveAim::stable || round == most_rounds) return ballast;
    asked.required_t += *short_t + beyond_t;
  }
}

TriangleMesh ballast_volume(const Ballast& ballast, const Box3& model) {
  Box3 box = model;  // its floor stays: Cura drops to the plate what lies lowest
  box.min = box.min - Vec3{beside_model_mm, beside_model_mm, 0};
  box.max = box.max + Vec3{beside_model_mm, beside_model_mm, beside_model_mm};
  return part_of_box(box, ballast.infill.dense);
}

std::vector<Region> printed_body(const PredictedPrint& print, const StandOptions& options) {
  return print.body(printed_density(options));
}

BallastFigures ballast_figures(const Ballast& ballast, const JointProblem& joint, const StandOptions& options) {
  return {profile_with_ballast(options).infill_ratio,
          ballast.infill.infill_ratio,
          ballast.infill.dense,
          ballast.added_mm3,
          ballast.added_mm3 * printed_density(options) * 1e-3,
          joint.bound_rad(ballast.bound_t),
          joint.bound_of,
          static_cast<std::size_t>(ballast.planes)};
}

Result<std::vector<Region>> body_of(const SolidMesh& solid, const std::optional<LayeredPrint>& layers,
                                    const StandOptions& options, const std::optional<Ballast>& ballast,
                                    const Job& job) {
  if (!layers) return std::vector{Region{solid.moments(), options.density_g_per_cm3, 0.02}};
  const auto low = ballast ? with_low_infill(*layers, solid, options, job.part(0, 0.5)) : *layers;
  if (!low) return tl::unexpected(low.error());
  const auto print = low->fill(ballast ? std::optional(ballast->infill) : std::nullopt, job.part(0.5, 1));
  if (!print) return tl::unexpected(print.error());
  auto body = printed_body(*print, options);
  if (body.empty()) return fail(ErrorCode::unusable_input, "with this profile nothing of the model is printed");
  return body;
}

void note_sliced(Report& report) {
  const PoseReport& pose = report.poses.front();
  const double before_g = mass_g(pose.before), after_g = mass_g(*pose.after);
  if (after_g > before_g)
    report.hints.push_back(
        fmt::format("sliced with this profile it becomes heavier: {:.4g} g instead of {:.4g}, for the slicer puts "
                    "skins round voids; at 100 % infill they make it lighter",
                    after_g, before_g));
  if (report.outcome == Outcome::best_effort)
    report.hints.emplace_back(
        "the angle is that of the sliced print, whose infill weighs little beside its walls: sliced at 100 % infill a "
        "void does more, and so may denser infill on one side (--ballast, into a 3MF)");
}

}  // namespace aplomb
