#include "aplomb/report/landing_list.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace aplomb {
namespace {

double degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

/// Without the -0 that a person does not want to read.
double rounded(double value, double unit) { return std::round(value / unit) * unit + 0.0; }

}  // namespace

Vec3 turns_upright_rad(Vec3 up) {
  // About x into the plane y = 0, then about y.
  const double about_x = std::atan2(up.y, up.z);
  return {about_x, -std::atan2(up.x, std::hypot(up.y, up.z)), 0};
}

std::string to_text(const std::vector<Landing>& landings) {
  if (landings.empty()) return "It rests on no face\n";
  std::string text = fmt::format("It can rest in {} {}\n", landings.size(), landings.size() == 1 ? "way" : "ways");
  text += "  no.  chance  tip angle  centre of mass  contact      turn it up with\n";
  int number = 0;
  for (const auto& [face, chance] : landings) {
    const Vec3 turns = turns_upright_rad(face.up);
    text += fmt::format("  {:>3}  {:>5.1f}%  {:>5.1f} deg  {:>8.1f} mm up  {:>7.4g} mm2  --rotate {:.4g},{:.4g},0\n",
                        ++number, 100 * chance, degrees(face.tip_rad), face.com_height_mm, face.area_mm2,
                        rounded(degrees(turns.x), 0.01), rounded(degrees(turns.y), 0.01));
  }
  return text;
}

std::string to_json(const std::vector<Landing>& landings) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const auto& [face, chance] : landings) {
    const Vec3 turns = turns_upright_rad(face.up);
    list.push_back({{"up", {face.up.x, face.up.y, face.up.z}},
                    {"rotate_deg", {degrees(turns.x), degrees(turns.y), 0}},
                    {"chance", chance},
                    {"tip_deg", degrees(face.tip_rad)},
                    {"com_height_mm", face.com_height_mm},
                    {"area_mm2", face.area_mm2}});
  }
  return Json{{"poses", list}}.dump(2) + "\n";
}

}  // namespace aplomb
