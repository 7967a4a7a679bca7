#include "aplomb/deform/reshape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "aplomb/mesh/trim.h"

namespace aplomb {
namespace {

constexpr int trims_tried = 8;
constexpr double default_trim_ratio = 0.01;  // of the height
constexpr std::array<double, 3> reported_trims_mm{0.5, 1, 2};

/// The pose whose base may be cut, if there is one.
const StandingPose* cut_pose(const std::vector<Pose>& poses) {
  const StandingPose* standing = poses.size() == 1 ? poses.front().standing() : nullptr;
  return standing && standing->up == Vec3{0, 0, 1} ? standing : nullptr;
}

struct Trims {
  std::vector<TrimGain> gains;
  double chosen_mm = 0;
};

Result<Trims> choose_trim(const SolidMesh& solid, const StandingPose& pose, RowKind kind, const ReshapeOptions& options,
                          const Job& job) {
  const double most = options.most_trim_mm.value_or(default_trim_ratio * solid.box().size().z);
  if (most == 0) return Trims{};
  std::vector<double> trims{0};
  for (int n = 1; n <= trims_tried; ++n) trims.push_back(most * n / trims_tried);
  trims.insert(trims.end(), reported_trims_mm.begin(), reported_trims_mm.end());
  std::ranges::sort(trims);
  trims.erase(std::unique(trims.begin(), trims.end()), trims.end());
  auto gains = trim_gains(solid, pose, kind, wall_of(solid, options), trims, job);
  if (!gains) return tl::unexpected(gains.error());
  std::vector<TrimGain> allowed;
  std::ranges::copy_if(*gains, std::back_inserter(allowed), [&](const TrimGain& g) { return g.trim_mm <= most; });
  return Trims{std::move(*gains), chosen_trim_mm(allowed, std::tan(pose.required_tip_rad))};
}

}  // namespace

struct Reshaper::Parts {
  SolidMesh solid;  // cut
  Trims trims;
  bool cut_serves = false;
  double required_t = 0;
  DeformOptions options;
  std::optional<Bender> bender;
};

std::string find_problem(const ReshapeOptions& o) {
  if (!(o.most_mean_percent > 0 && o.most_mean_percent <= 100))
    return fmt::format("most_mean_percent is {}; it must lie in (0, 100]", o.most_mean_percent);
  if (o.most_trim_mm && !(*o.most_trim_mm >= 0 && *o.most_trim_mm <= 1e4))
    return fmt::format("most_trim_mm is {}; it must lie in [0, 10000]", *o.most_trim_mm);
  if (std::string problem = find_problem(o.regions); !problem.empty()) return problem;
  if (!(o.wall_mm > 0)) return fmt::format("wall_mm is {}; it must be positive", o.wall_mm);
  return {};
}

double wall_of(const SolidMesh& solid, const ReshapeOptions& options) {
  return options.carves ? options.wall_mm : solid.box().diagonal();
}

Result<Reshaper> Reshaper::make(const SolidMesh& solid, const std::vector<Pose>& poses, RowKind kind,
                                const ReshapeOptions& options, const Job& job) {
  assert(find_problem(options).empty() && find_problem(poses).empty());
  Parts parts{solid, {}, false, 0, {}, std::nullopt};
  if (const StandingPose* pose = cut_pose(poses)) {
    auto trims = choose_trim(solid, *pose, kind, options, job.part(0, 0.4));
    if (!trims) return tl::unexpected(trims.error());
    parts.trims = std::move(*trims);
    if (parts.trims.chosen_mm > 0) {
      auto cut = trim_base(solid, solid.box().min.z + parts.trims.chosen_mm, job.part(0.4, 0.5));
      if (cut) parts.solid = std::move(*cut);
      else if (cut.error().code == ErrorCode::cancelled) return tl::unexpected(cut.error());
      else parts.trims.chosen_mm = 0;
    }
    for (const TrimGain& gain : parts.trims.gains)
      parts.cut_serves |= options.regions.handles.empty() && parts.trims.chosen_mm > 0 &&
                          gain.trim_mm == parts.trims.chosen_mm && gain.t >= std::tan(pose->required_tip_rad);
  }
  const auto joint = joint_problem(parts.solid.mesh(), poses, kind);
  if (!joint) return tl::unexpected(joint.error());
  parts.required_t = joint->required_t;
  parts.options.most_mean_mm = options.most_mean_percent / 100 * solid.box().size().z;
  const BendProblem problem = bend_problem(parts.solid, poses, joint->problem, options.regions);
  auto bender = Bender::make(parts.solid, problem, {.wall_mm = wall_of(solid, options)}, job.part(0.5, 1));
  if (!bender) return tl::unexpected(bender.error());
  parts.bender = std::move(*bender);
  return Reshaper(std::make_shared<const Parts>(std::move(parts)));
}

Result<Reshaping> Reshaper::reshape(double beyond_t, const Job& job) const {
  if (parts_->cut_serves && beyond_t <= 0) return Reshaping{parts_->solid, trim_mm(), std::nullopt};
  auto bent = parts_->bender->bend(parts_->required_t + beyond_t, parts_->options, job);
  if (!bent) return tl::unexpected(bent.error());
  const SolidMesh solid = bent->solid;
  return Reshaping{solid, trim_mm(), std::move(*bent)};
}

const std::vector<TrimGain>& Reshaper::gains() const { return parts_->trims.gains; }
double Reshaper::trim_mm() const { return parts_->trims.chosen_mm; }

}  // namespace aplomb
