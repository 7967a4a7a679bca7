#include "aplomb/advice.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "aplomb/balance/attachments.h"

#include "aplomb/inserted.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// How far half the wall would go, on a coarse grid: the bound of t; nothing where that cannot be told.
Result<std::optional<double>> t_with_half_wall(const Input& input, const JointProblem& joint,
                                               const StandOptions& options, const Job& job) {
  using Bound = std::optional<double>;
  const auto untold = [](const Error& error) {
    return error.code == ErrorCode::cancelled ? Result<Bound>(cancelled()) : Result<Bound>(Bound());
  };
  VolumeOptions coarse{options.wall_mm / 2, options.wall_mm / 4, 0, options.memory_bytes};
  const auto volume = voxelize(input.solid, coarse, job.part(0, 0.7));
  if (!volume) return untold(volume.error());
  const Moments loaded = input.moments + inserts_as_solid(input.inserts, options);
  const auto bound_t = carving_bound(*volume, loaded, joint.problem, 1e-4, job.part(0.7, 1));
  return bound_t ? Result<Bound>(*bound_t) : untold(bound_t.error());
}

std::string half_wall_text(double t, const JointProblem& joint) {
  const double angle_deg = joint.angle_rad(t) / degree;
  switch (joint.bound_of) {
    case BoundOf::tip:
      return fmt::format("reach about {:.1f} degrees", angle_deg);
    case BoundOf::tilt:
      return fmt::format("come to about {:.1f} degrees from level", angle_deg);
    case BoundOf::surplus:
      break;
  }
  return t >= 0 ? "meet every pose" : "still not meet every pose";
}

std::string would_hold(BoundOf bound_of, double bound_deg) {
  switch (bound_of) {
    case BoundOf::tip:
      return fmt::format("it would stand: up to {:.1f} degrees", bound_deg);
    case BoundOf::tilt:
      return fmt::format("it would hang as asked: {:.1f} degrees from level at best", bound_deg);
    case BoundOf::surplus:
      break;
  }
  return "it would hold in every pose";
}

}  // namespace

void add_ceiling_hints(Report& report, bool reaches) {
  const auto& ceiling = report.carving->ceiling;
  if (!ceiling) return;
  if (ceiling->left > 0)
    report.hints.push_back(
        fmt::format("not all ceilings of the voids print as they are: {} left (see the judgement)",
                    ceiling->left == 1 ? "1 place is" : fmt::format("{} places are", ceiling->left)));
  if (ceiling->reached_without && !reaches)
    report.hints.push_back(fmt::format("with ceilings as they come (--ceiling any) {}",
                                       would_hold(report.carving->bound_of, ceiling->bound_rad / degree)));
}

void note_loose_attachments(Report& report, const TriangleMesh& mesh) {
  for (const PoseReport& entry : report.poses)
    if (const HangingPose* hanging = entry.pose.hanging())
      for (const auto& [at, distance] : loose_attachments(mesh, *hanging))
        report.hints.push_back(
            fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) mm to hang from is {:.3g} mm off the model", at.x, at.y,
                        at.z, distance));
}

Result<void> add_advice(Report& report, const Input& input, const JointProblem& joint, const StandOptions& options,
                        const Job& job) {
  const auto t = t_with_half_wall(input, joint, options, job);
  if (!t) return tl::unexpected(t.error());
  if (*t)
    report.hints.push_back(
        fmt::format("with a wall of {:.3g} mm, or printed twice as high with the wall as it is, carving could {}",
                    options.wall_mm / 2, half_wall_text(**t, joint)));
  if (report.after && report.after->pedestal)
    report.hints.push_back(fmt::format("on a round pedestal {:.3g} mm across and {:.3g} mm thick it would stand",
                                       2 * report.after->pedestal->radius_mm, report.after->pedestal->thickness_mm));
  report.hints.push_back(report.has_standing_pose()
                             ? "a wider base, or a pose that leans less, would help"
                             : "another point to hang from, nearer to straight above the centre of mass, would help");
  if (options.deform == Deform::never) report.hints.push_back("bending the surface a little would help: --deform auto");
  else if (report.deformation && report.deformation->outcome == "limit")
    report.hints.push_back("a larger --deform-limit or --trim-base would allow more");
  return {};
}

}  // namespace aplomb
