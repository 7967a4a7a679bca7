#include "aplomb/advice.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "aplomb/balance/attachments.h"

#include "aplomb/inserted.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// How far half the wall would go, on a coarse grid: the bound of t.
std::optional<double> t_with_half_wall(const Input& input, const JointProblem& joint, const StandOptions& options,
                                       const Job& job) {
  VolumeOptions coarse{options.wall_mm / 2, options.wall_mm / 4, 0, options.memory_bytes};
  const auto volume = voxelize(input.solid, coarse, job.part(0, 0.7));
  if (!volume) return std::nullopt;
  const Moments loaded = input.moments + inserts_as_solid(input.inserts, options);
  const auto bound_t = carving_bound(*volume, loaded, joint.problem, 1e-4, job.part(0.7, 1));
  return bound_t ? std::optional(*bound_t) : std::nullopt;
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

}  // namespace

void note_loose_attachments(Report& report, const TriangleMesh& mesh) {
  for (const PoseReport& entry : report.poses)
    if (const HangingPose* hanging = entry.pose.hanging())
      for (const auto& [at, distance] : loose_attachments(mesh, *hanging))
        report.hints.push_back(
            fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) mm to hang from is {:.3g} mm off the model", at.x, at.y,
                        at.z, distance));
}

void add_advice(Report& report, const Input& input, const JointProblem& joint, const StandOptions& options,
                const Job& job) {
  if (const auto t = t_with_half_wall(input, joint, options, job))
    report.hints.push_back(
        fmt::format("with a wall of {:.3g} mm, or printed twice as high with the wall as it is, carving could {}",
                    options.wall_mm / 2, half_wall_text(*t, joint)));
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

}  // namespace aplomb
