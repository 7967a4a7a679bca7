#include "solver/preview.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace aplomb::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degree = std::numbers::pi / 180;
constexpr int most_stages = 100;  // of one wish

/// How the poses hold the bent solid, uncarved: as measure_pose() has it, without what only a report tells.
Result<Json> poses_of(const TriangleMesh& surface, const Moments& body, const StandOptions& options) {
  const std::array regions{Region{body, options.density_g_per_cm3, 0.02}};
  Json list = Json::array();
  for (std::size_t i = 0; i < options.poses.size(); ++i) {
    const Pose& pose = options.poses[i];
    Json& said = list.emplace_back();
    said["name"] = pose.name.empty() ? fmt::format("pose {}", i + 1) : pose.name;
    if (const HangingPose* hanging = pose.hanging()) {
      const Hanging measured = measure_hanging(regions, *hanging);
      said["tilt_deg"] = measured.tilt_rad / degree;
      said["holds"] = holds(pose, measured, kind_of(options));
      continue;
    }
    auto support = support_polygon(surface, *pose.standing());
    if (!support) return tl::unexpected(support.error());
    Standing measured;
    measured.stability = measure_stability(*support, regions, *pose.standing());
    said["tip_deg"] = measured.stability.tip_rad / degree;
    said["holds"] = holds(pose, measured, kind_of(options));
  }
  return list;
}

Result<std::string> message_of(const BendStage& stage, const JointProblem& joint, const StandOptions& options,
                               double wish) {
  const Moments body = moments(stage.surface);
  if (!(body.volume_mm3 > 0)) return fail(ErrorCode::third_party, "bent so far, nothing of the solid is left");
  auto poses = poses_of(stage.surface, body, options);
  if (!poses) return tl::unexpected(poses.error());
  const Vec3 center = body.centroid_mm();
  Json carved;
  if (options.deform != Deform::only && joint.bound_of != BoundOf::surplus) carved = joint.angle_rad(stage.t) / degree;
  const Json message{{"type", "preview"},
                     {"wish", wish},
                     {"settled", stage.settled},
                     {"mean_mm", stage.mean_mm},
                     {"max_mm", stage.max_mm},
                     {"handle_short_mm", stage.handle_short_mm},
                     {"center_mm", {center.x, center.y, center.z}},
                     {"poses", std::move(*poses)},
                     {"carved_deg", carved}};
  return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Result<JobFile> parse_bending_job(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || json.value("deform", Json("never")) != "never" || !json.contains("handles"))
    return parse_job(text, "");
  json["deform"] = "auto";
  auto job = parse_job(json.dump(-1, ' ', false, Json::error_handler_t::replace), "");
  if (job) job->options.deform = Deform::never;
  return job;
}

Result<void> preview(const JobFile& job, double wish, const Input& input, Desk& desk, Outbox& out) {
  const Job work = out.work(false);
  const StandOptions options = stand_options(job, input.solid.box().size().z);
  const auto bender = desk.bender(input, options, work);
  if (!bender) return tl::unexpected(bender.error());
  BendWish asked{.regions = options.reshape.regions, .balances = options.deform != Deform::never};
  for (int n = 0; n < most_stages; ++n) {
    asked.most_steps = n == 0 ? 1 : 2;  // the first answer is the one that is waited for
    auto stage = (*bender)->advance(asked, desk.bent, work);
    if (!stage) return tl::unexpected(stage.error());
    const auto message = message_of(*stage, (*bender)->joint(), options, wish);
    if (!message) return tl::unexpected(message.error());
    desk.bent = std::move(stage->cage);
    if (out.is_cancelled()) return cancelled();
    out.json(*message);
    out.positions(stage->surface.vertices);
    if (stage->settled) break;
  }
  return {};
}

}  // namespace aplomb::studio
