#include "solver/preview.h"

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "aplomb/report/json.h"

namespace aplomb::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degree = std::numbers::pi / 180;
constexpr int most_stages = 100;  // of one wish

/// How the poses hold the bent solid, uncarved, and what they would reach if the best void for all were carved: null
/// where nothing is to be carved.
Result<Json> poses_of(const BendStage& stage, const Moments& body, const JointProblem& joint,
                      const StandOptions& options) {
  const std::array regions{Region{body, options.density_g_per_cm3, 0.02}};
  Json list = Json::array();
  for (const Pose& pose : options.poses) {
    auto measured = measure_pose(stage.surface, regions, pose);
    if (!measured) return tl::unexpected(measured.error());
    const bool does_hold = holds(pose, *measured, kind_of(options));
    const PoseReport report{pose, std::move(*measured), std::nullopt, does_hold};
    Json& said = list.emplace_back(Json::parse(to_json(report, list.size() + 1)));
    said["carved_deg"] = nullptr;
    if (options.deform != Deform::only) said["carved_deg"] = angle_at_rad(pose, joint, stage.t) / degree;
  }
  return list;
}

Result<std::string> message_of(const BendStage& stage, const JointProblem& joint, const StandOptions& options,
                               double wish) {
  const Moments body = moments(stage.surface);
  if (!(body.volume_mm3 > 0)) return fail(ErrorCode::third_party, "bent so far, nothing of the solid is left");
  auto poses = poses_of(stage, body, joint, options);
  if (!poses) return tl::unexpected(poses.error());
  const Json message{{"type", "preview"},         {"wish", wish},           {"settled", stage.settled},
                     {"mean_mm", stage.mean_mm},  {"max_mm", stage.max_mm}, {"handle_short_mm", stage.handle_short_mm},
                     {"poses", std::move(*poses)}};
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
