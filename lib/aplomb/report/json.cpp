#include "aplomb/report/json.h"

#include "aplomb/report/judgement.h"

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

namespace aplomb {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

Json json(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

Json json(const Pedestal& pedestal) {
  return {{"center_mm", json(pedestal.center_mm)},
          {"radius_mm", pedestal.radius_mm},
          {"thickness_mm", pedestal.thickness_mm}};
}

Json json(const Standing& standing) {
  const Stability& s = standing.stability;
  Json corners = Json::array(), variants = Json::array();
  for (const Vec3& corner : standing.support.corners_in_model_mm()) corners.push_back(json(corner));
  for (const ContactVariant& v : standing.variants)
    variants.push_back(
        {{"contact_height_mm", v.contact_height_mm}, {"tip_deg", degrees(v.tip_rad)}, {"area_mm2", v.area_mm2}});
  Json object{
      {"mass_g", s.mass_g},
      {"volume_mm3", s.volume_mm3},
      {"com_mm", json(s.com_mm)},
      {"com_height_mm", s.com_height_mm},
      {"margin_mm", s.margin_mm},
      {"tip_deg", degrees(s.tip_rad)},
      {"robust_tip_deg", degrees(s.robust_tip_rad)},
      {"weak_edge",
       {{"from_mm", json(s.weak_edge_mm[0])}, {"to_mm", json(s.weak_edge_mm[1])}, {"heading", json(s.heading)}}},
      {"box_mm", Json::array({json(standing.box_mm.min), json(standing.box_mm.max)})},
      {"support_polygon_mm", corners},
      {"support_area_mm2", standing.support.area_mm2()},
      {"support_width_mm", standing.support.width_mm()},
      {"topple_energy_j", s.topple_energy_j},
      {"topple_push_n", s.topple_push_n},
      {"push_height_mm", s.push_height_mm},
      {"contact_variants", variants}};
  if (standing.pedestal) object["pedestal"] = json(*standing.pedestal);
  return object;
}

Json json(const Hanging& h) {
  return {{"mass_g", h.mass_g},       {"volume_mm3", h.volume_mm3},
          {"com_mm", json(h.com_mm)}, {"tilt_deg", degrees(h.tilt_rad)},
          {"drop_mm", h.drop_mm},     {"pulls_all_threads", h.pulls_all_threads}};
}

Json json(const PoseMeasure& measure) {
  return std::visit([](const auto& m) { return json(m); }, measure);
}

Json json(const PoseReport& entry, std::size_t number) {
  const std::string name = entry.pose.name.empty() ? "pose " + std::to_string(number) : entry.pose.name;
  Json object{{"name", name}, {"kind", entry.pose.hanging() ? "hanging" : "standing"}, {"up", json(entry.pose.up())}};
  if (const HangingPose* hanging = entry.pose.hanging()) {
    object["required_tilt_deg"] = degrees(hanging->required_tilt_rad);
    object["attachments_mm"] = Json::array();
    for (const Vec3& point : hanging->attachments_mm) object["attachments_mm"].push_back(json(point));
  } else {
    object["required_tip_deg"] = degrees(entry.pose.standing()->required_tip_rad);
  }
  object["holds"] = entry.holds;
  object["before"] = json(entry.before);
  if (entry.after) object["after"] = json(*entry.after);
  return object;
}

const char* bound_key(BoundOf of) {
  constexpr std::array<const char*, 3> bounds{"bound_deg", "bound_tilt_deg", "bound_surplus_deg"};
  return bounds[static_cast<std::size_t>(of)];
}

Json json(const InsertFigures& inserts) {
  constexpr std::array<const char*, 3> reached{"reached_deg", "reached_tilt_deg", "reached_surplus_deg"};
  Json pockets = Json::array();
  for (const PocketFigures& p : inserts.pockets)
    pockets.push_back({{"name", p.name},
                       {"count", p.count},
                       {"mass_g", p.mass_g},
                       {"at_mm", json(p.at_mm)},
                       {"diameter_mm", p.diameter_mm},
                       {"floor_mm", p.floor_mm},
                       {"pause_mm", p.pause_mm},
                       {"first_print_mm", p.first_print_mm}});
  return {{"count", inserts.count()},
          {"allowed", inserts.allowed},
          {reached[static_cast<std::size_t>(inserts.bound_of)], degrees(inserts.reached_rad)},
          {bound_key(inserts.bound_of), degrees(inserts.bound_rad)},
          {"step_mm", inserts.step_mm},
          {"layer_mm", inserts.layer_mm},
          {"pockets", pockets}};
}

Json json(const CarvingFigures& c) {
  const char* bound = bound_key(c.bound_of);
  Json object{{"aim", c.aim},
              {"void_mm3", c.void_mm3},
              {bound, degrees(c.bound_rad)},
              {"gap_deg", degrees(c.gap_rad)},
              {"planes", c.planes}};
  if (const auto& ceiling = c.ceiling)
    object["ceiling"] = {{"ribs", ceiling->ribs},
                         {"pillars", ceiling->pillars},
                         {"fills", ceiling->fills},
                         {"rounds", ceiling->rounds},
                         {"findings_left", ceiling->left},
                         {bound, degrees(ceiling->bound_rad)},
                         {"cost_deg", degrees(ceiling->cost_rad)},
                         {"material_mm3", ceiling->material_mm3}};
  return object;
}

Json json(const BallastFigures& b) {
  return {{"infill_percent", {100 * b.low_ratio, 100 * b.high_ratio}},
          {"dense", {{"constant", b.dense.constant}, {"gradient", json(b.dense.gradient)}}},
          {"added_mm3", b.added_mm3},
          {"added_g", b.added_g},
          {bound_key(b.bound_of), degrees(b.bound_rad)},
          {"planes", b.planes}};
}

Json json(const DeformationFigures& d) {
  Json trims = Json::array();
  for (const auto& [trim_mm, tip_rad] : d.trims) trims.push_back({{"trim_mm", trim_mm}, {"tip_deg", degrees(tip_rad)}});
  return {{"outcome", d.outcome},
          {"max_mm", d.max_mm},
          {"mean_mm", d.mean_mm},
          {"handle_short_mm", d.handle_short_mm},
          {"max_turn_deg", degrees(d.max_turn_rad)},
          {"volume_change_percent", 100 * d.volume_change_ratio},
          {"iterations", d.iterations},
          {"energy", d.energy_mm3},
          {"trim_mm", d.trim_mm},
          {"trims", trims}};
}

Json json(const HoleFigures& hole) {
  return {{"mouth_mm", json(hole.mouth_mm)},
          {"throat_mm", json(hole.throat_mm)},
          {"outward", json(hole.outward)},
          {"diameter_mm", hole.diameter_mm},
          {"depth_mm", hole.depth_mm}};
}

Json json(const MeshFigures& m) {
  return {{"outer_unchanged", m.outer_unchanged},
          {"closed", m.closed},
          {"self_intersections", m.self_intersections},
          {"voids", m.voids},
          {"triangles", m.triangles}};
}

}  // namespace

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::already_stands:
      return "already_stands";
    case Outcome::stands:
      return "stands";
    case Outcome::best_effort:
      return "best_effort";
    case Outcome::falls:
      break;
  }
  return "falls";
}

std::string to_json(const PoseReport& pose, std::size_t number) {
  return json(pose, number).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_json(const Report& report) {
  Json object{{"version", report.version}, {"outcome", to_string(report.outcome)}};
  if (report.has_standing_pose()) {
    object["required_tip_deg"] = degrees(report.required_tip_rad);
    object["before"] = json(report.before);
  }
  if (report.after) object["after"] = json(*report.after);
  object["poses"] = Json::array();
  for (std::size_t i = 0; i < report.poses.size(); ++i) object["poses"].push_back(json(report.poses[i], i + 1));
  if (report.carving) object["carving"] = json(*report.carving);
  if (report.ballast) object["ballast"] = json(*report.ballast);
  if (report.deformation) object["deformation"] = json(*report.deformation);
  if (report.inserts) object["inserts"] = json(*report.inserts);
  if (report.wall) object["wall_mm"] = {{"required", report.wall->required_mm}, {"measured", report.wall->measured_mm}};
  for (const HoleFigures& hole : report.holes) object["holes"].push_back(json(hole));
  if (report.mesh) object["mesh"] = json(*report.mesh);
  if (report.judgement) object["judgement"] = Json::parse(to_json(*report.judgement));
  object["repair"] = report.repair;
  object["hints"] = report.hints;
  object["seconds"] = Json::object();
  for (const auto& [stage, seconds] : report.stage_seconds) object["seconds"][stage] = seconds;
  object["peak_memory_mb"] = report.peak_memory_mb;
  object["options"] = Json::object();
  for (const auto& [name, value] : report.options)
    std::visit([&, &key = name](const auto& v) { object["options"][key] = v; }, value);
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace aplomb
