#include "aplomb/report/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "aplomb/report/text.h"

namespace aplomb {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

std::string line(std::string_view name, const std::string& text) { return fmt::format("  {:<18}{}\n", name, text); }

std::string point(Vec3 p) { return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", p.x, p.y, p.z); }

std::string headline(const VerifiedObject& object, double required_tip_rad) {
  const Stability& s = object.stability;
  const double tip_deg = degrees(s.tip_rad), asked_deg = degrees(required_tip_rad);
  const std::string name = object.printed.name.empty() ? "the print" : object.printed.name;
  if (!s.can_stand) return fmt::format("Would topple: {}'s first layer is a point or a line\n", name);
  const std::string_view verdict = object.stands ? "Stands as printed" : "Would topple";
  return fmt::format("{}: {}, tip angle {:.1f} degrees ({:.1f} asked), weakest towards {}\n", verdict, name, tip_deg,
                     asked_deg, direction_word(s.heading));
}

std::string error_text(const PrintError& error, double told_tip_rad) {
  const Vec3& d = error.com_mm;
  std::string text =
      line("against report", fmt::format("mass {:+.1f} %, centre of mass off by {:.2f} mm ({:+.2f}, {:+.2f}, "
                                         "{:+.2f}), {:.1f} degrees told",
                                         100 * error.mass_ratio, norm(d), d.x, d.y, d.z, degrees(told_tip_rad)));
  if (error.has_other_size)
    text += line("", "its size is not the model's: was it scaled or turned, or is it another model?");
  if (!error.is_within_limits) text += line("", "this is not what the report promised");
  return text;
}

std::string figures(const VerifiedObject& object, const std::optional<double>& told_tip_rad) {
  const Stability& s = object.stability;
  const PrintedObject& printed = object.printed;
  std::string text =
      line("mass", fmt::format("{:.2f} g, {:.2f} cm3", s.mass_g, s.volume_mm3 * 1e-3)) +
      line("centre of mass", fmt::format("{} on the bed, {:.1f} mm above it", point(s.com_mm), s.com_height_mm)) +
      line("first layer", fmt::format("{:.0f} mm2 of hull, {:.2f} mm high, beads {:.2f} mm wide",
                                      printed.contact.area_mm2(), printed.contact_layer_mm, printed.bead_width_mm)) +
      line("margin", fmt::format("{:.2f} mm, over the edge {} to {}", s.margin_mm, point(s.weak_edge_mm[0]),
                                 point(s.weak_edge_mm[1])));
  if (object.with_brim)
    text +=
        line("with its brim", fmt::format("{:.1f} degrees, until it is taken off", degrees(object.with_brim->tip_rad)));
  if (object.error) text += error_text(*object.error, *told_tip_rad);
  return text;
}

Json json(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

Json json(const VerifiedObject& object) {
  const Stability& s = object.stability;
  const PrintedObject& printed = object.printed;
  Json corners = Json::array();
  for (const Vec3& corner : printed.contact.corners_in_model_mm()) corners.push_back(json(corner));
  Json out{{"name", printed.name},
           {"stands", object.stands},
           {"mass_g", s.mass_g},
           {"volume_mm3", s.volume_mm3},
           {"com_mm", json(s.com_mm)},
           {"com_height_mm", s.com_height_mm},
           {"margin_mm", s.margin_mm},
           {"tip_deg", degrees(s.tip_rad)},
           {"weak_edge",
            {{"from_mm", json(s.weak_edge_mm[0])}, {"to_mm", json(s.weak_edge_mm[1])}, {"heading", json(s.heading)}}},
           {"box_mm", Json::array({json(printed.box_mm.min), json(printed.box_mm.max)})},
           {"first_layer",
            {{"plate_mm", printed.contact.frame.plate_mm},
             {"height_mm", printed.contact_layer_mm},
             {"bead_width_mm", printed.bead_width_mm},
             {"hull_area_mm2", printed.contact.area_mm2()},
             {"hull_mm", corners}}}};
  if (object.with_brim) out["with_brim"] = {{"tip_deg", degrees(object.with_brim->tip_rad)}};
  if (const auto& error = object.error)
    out["error"] = {{"mass_percent", 100 * error->mass_ratio},
                    {"com_mm", json(error->com_mm)},
                    {"com_distance_mm", norm(error->com_mm)},
                    {"has_other_size", error->has_other_size},
                    {"is_within_limits", error->is_within_limits}};
  return out;
}

}  // namespace

std::string to_text(const Verification& v) {
  std::string text;
  for (const VerifiedObject& object : v.objects)
    text += headline(object, v.required_tip_rad) + figures(object, v.told_tip_rad);
  for (const LeftOut& part : v.plate.left_out)
    text += line("left out", fmt::format("{:.2f} g {}", part.mass_g, part.what));
  for (const Filament& f : v.plate.filaments)
    text += line("filament", fmt::format("tool {}: {:g} mm, {:g} g/cm3", f.tool, f.diameter_mm, f.density_g_per_cm3));
  for (const std::string& note : v.plate.notes) text += line("note", note);
  return text;
}

std::string to_json(const Verification& v) {
  Json out{{"stands", v.all_stand()}};
  if (v.told_tip_rad) out["as_told"] = v.all_as_told();
  out["required_tip_deg"] = degrees(v.required_tip_rad);
  out["slicer"] = v.plate.slicer;
  out["filament_mm"] = v.plate.filament_mm;
  for (const char* list : {"filaments", "objects", "left_out"}) out[list] = Json::array();
  for (const Filament& f : v.plate.filaments)
    out["filaments"].push_back({{"tool", f.tool},
                                {"diameter_mm", f.diameter_mm},
                                {"density_g_per_cm3", f.density_g_per_cm3},
                                {"diameter_is_known", f.diameter_is_known},
                                {"density_is_known", f.density_is_known}});
  for (const VerifiedObject& object : v.objects) out["objects"].push_back(json(object));
  for (const LeftOut& part : v.plate.left_out)
    out["left_out"].push_back({{"what", part.what}, {"mass_g", part.mass_g}});
  out["notes"] = v.plate.notes;
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace aplomb
