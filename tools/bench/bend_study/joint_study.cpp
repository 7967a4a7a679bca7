#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies.h"

namespace aplomb::bench {
namespace {

/// The part of a ball on the positive side of a plane at `distance` from its centre.
double ball_share(double distance, double radius) {
  const double s = std::clamp(distance / radius, -1.0, 1.0);
  return (2 + 3 * s - s * s * s) / 4;
}

CageProblem without_carving(CageProblem problem) {
  for (SolidSample& sample : problem.samples) sample.carvable = 0;
  return problem;
}

/// The solid with a void that stays what it is: where `kept` is not positive there is nothing to balance.
CageProblem carved_beforehand(CageProblem problem, const AffineForm& kept) {
  std::vector<SolidSample> left;
  for (SolidSample sample : problem.samples) {
    const double radius_mm = std::cbrt(3 * sample.volume_mm3 / (4 * std::numbers::pi));
    const Vec3 at = sample.at.position(problem.rest, problem.rest.vertices);
    sample.volume_mm3 *= 1 - sample.carvable * (1 - ball_share(kept(at) / norm(kept.gradient), radius_mm));
    sample.carvable = 0;
    if (sample.volume_mm3 > 0) left.push_back(sample);
  }
  problem.samples = std::move(left);
  return problem;
}

std::string told(const CageDeformation& cage, const StudyOptions& options) {
  const double percent = 100 * cage.mean_mm / options.height_mm;
  if (cage.outcome == DeformOutcome::reached) return fmt::format("{:.2f}", percent);
  const char* end = cage.outcome == DeformOutcome::limit ? "limit" : "stuck";
  return fmt::format("{}: {:.1f} deg at {:.1f}", end, degrees_of(cage.t), percent);
}

std::string ratio(const CageDeformation& cage, const CageDeformation& joint) {
  const bool both = cage.outcome == DeformOutcome::reached && joint.outcome == DeformOutcome::reached;
  return both && joint.mean_mm > 0 ? fmt::format("{:.2f}", cage.mean_mm / joint.mean_mm) : "";
}

Result<void> print_row(const StudyModel& model, const StudyOptions& options) {
  const CageProblem solid = without_carving(model.problem);
  const auto uncarved = at_rest(solid), carved = at_rest(model.problem);
  if (!uncarved) return tl::unexpected(uncarved.error());
  if (!carved) return tl::unexpected(carved.error());
  const double t = asked_t(options, carved->t);
  const auto joint = bent(model.problem, t, options), alone = bent(solid, t, options),
             after = bent(carved_beforehand(model.problem, carved->kept), t, options);
  for (const auto* way : {&joint, &alone, &after})
    if (!*way) return tl::unexpected(way->error());
  fmt::print("| {} | {:.1f} | {:.1f} | {:.1f} | {} | {} | {} | {} | {} |\n", model.name, degrees_of(uncarved->t),
             degrees_of(carved->t), degrees_of(t), told(*joint, options), told(*alone, options), told(*after, options),
             ratio(*alone, *joint), ratio(*after, *joint));
  return {};
}

}  // namespace

Result<void> study_joint(const std::vector<std::string>& models, const StudyOptions& options) {
  fmt::print(
      "| model | solid deg | carved deg | asked deg | together % | bent only % | carved first % | bent only / "
      "together | carved first / together |\n|---|---|---|---|---|---|---|---|---|\n");
  return for_each_model(models, options, print_row);
}

}  // namespace aplomb::bench
