#include "aplomb/fdm/print_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "aplomb/core/printable.h"

namespace aplomb {
namespace {

using Settings = std::map<std::string, std::string, std::less<>>;

constexpr std::string_view blanks = " \t\r;";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// "name = value" lines; a comment's semicolon is left out.
Settings settings_in_lines(std::string_view text) {
  Settings settings;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t equals = line.find('=');
    if (equals == line.npos || equals > 80) continue;
    settings.insert_or_assign(std::string(trimmed(line.substr(0, equals))),
                              std::string(trimmed(line.substr(equals + 1))));
  }
  return settings;
}

Settings settings_in_json(std::string_view text) {
  Settings settings;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return settings;
  for (const auto& [name, value] : json.items())
    if (value.is_primitive()) settings[name] = value.is_string() ? value.get<std::string>() : value.dump();
  return settings;
}

/// Settings by name, as numbers; the first that cannot be read is remembered.
class Reader {
 public:
  explicit Reader(const Settings& settings) : settings_(settings) {}

  bool has(std::string_view name) const { return settings_.find(name) != settings_.end(); }
  std::string text(std::string_view name, std::string_view otherwise) const {
    const auto found = settings_.find(name);
    return found == settings_.end() ? std::string(otherwise) : found->second;
  }
  /// The first of a list by tool; shares are of `whole`.
  double number(std::string_view name, double otherwise, double whole = 1) {
    const auto found = settings_.find(name);
    if (found == settings_.end()) return otherwise;
    const std::string& value = found->second;
    if (value == "true" || value == "True") return 1;
    if (value == "false" || value == "False") return 0;
    double parsed = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), parsed);
    if (error == std::errc{} && std::isfinite(parsed))
      return end < value.data() + value.size() && *end == '%' ? parsed / 100 * whole : parsed;
    if (problem_.empty()) problem_ = fmt::format("{} is '{}', which is no number", name, printable(value));
    return otherwise;
  }
  const std::string& problem() const { return problem_; }

 private:
  const Settings& settings_;
  std::string problem_;
};

/// A count of walls or layers: find_problem() refuses what is out of its range, but an int must hold it.
int count_of(double count) { return std::isnan(count) ? -1 : static_cast<int>(std::clamp(count, -1.0, 1e6)); }

int layers_of(double count, double least_mm, double layer_mm) {
  if (!(count > 0)) return 0;
  return static_cast<int>(std::min(1e6, std::max(count, std::ceil(least_mm / layer_mm - 1e-6))));
}

/// PrusaSlicer's own rule: 0 is 1.125 times the nozzle, a share is of the layer.
double width_of(Reader& r, std::string_view name, double layer_mm, double nozzle_mm) {
  double width = r.number(name, 0, layer_mm);
  if (width == 0) width = r.number("extrusion_width", 0, layer_mm);
  return width > 0 ? width : 1.125 * nozzle_mm;
}

PrintProfile prusaslicer_profile(Reader& r) {
  PrintProfile p;
  p.nozzle_mm = r.number("nozzle_diameter", 0.4);
  p.layer_mm = r.number("layer_height", 0.3);
  p.first_layer_mm = r.number("first_layer_height", 0.35, p.layer_mm);
  p.perimeters = count_of(r.number("perimeters", 3));
  p.external_width_mm = width_of(r, "external_perimeter_extrusion_width", p.layer_mm, p.nozzle_mm);
  p.perimeter_width_mm = width_of(r, "perimeter_extrusion_width", p.layer_mm, p.nozzle_mm);
  p.infill_width_mm = width_of(r, "infill_extrusion_width", p.layer_mm, p.nozzle_mm);
  p.solid_width_mm = width_of(r, "solid_infill_extrusion_width", p.layer_mm, p.nozzle_mm);
  p.top_layers = layers_of(r.number("top_solid_layers", 3), r.number("top_solid_min_thickness", 0), p.layer_mm);
  p.bottom_layers =
      layers_of(r.number("bottom_solid_layers", 3), r.number("bottom_solid_min_thickness", 0), p.layer_mm);
  p.infill_ratio = r.number("fill_density", 0.2);
  if (!r.text("fill_density", "20%").ends_with('%') && p.infill_ratio > 1) p.infill_ratio /= 100;
  p.infill_pattern = r.text("fill_pattern", "stars");
  const double gap_mm = 1 - std::numbers::pi / 4;  // of a layer, between beads with round sides
  const double solid_spacing_mm = p.solid_width_mm - gap_mm * p.layer_mm,
               spacing_mm = p.perimeter_width_mm - gap_mm * p.layer_mm;
  p.infill_overlap_mm =
      r.number("infill_overlap", 0.25 * (spacing_mm + solid_spacing_mm) / 2, (spacing_mm + solid_spacing_mm) / 2);
  p.solid_below_mm2 = r.number("solid_infill_below_area", 70);
  p.ensures_shell_thickness = r.number("ensure_vertical_shell_thickness", 0) > 0;
  p.thick_bridges = r.number("thick_bridges", 1) > 0;
  p.flow_ratio = r.number("extrusion_multiplier", 1);
  p.density_g_per_cm3 = r.number("filament_density", 0);
  return p;
}

PrintProfile cura_profile(Reader& r) {
  PrintProfile p;
  p.rules = PrintProfile::Rules::cura;
  p.nozzle_mm = r.number("machine_nozzle_size", 0.4);
  p.layer_mm = r.number("layer_height", 0.2);
  p.first_layer_mm = r.number("layer_height_0", p.layer_mm);
  const double line_mm = r.number("line_width", p.nozzle_mm), wall_mm = r.number("wall_line_width", line_mm);
  p.external_width_mm = r.number("wall_line_width_0", wall_mm);
  p.perimeter_width_mm = r.number("wall_line_width_x", wall_mm);
  p.infill_width_mm = r.number("infill_line_width", line_mm);
  p.solid_width_mm = r.number("skin_line_width", line_mm);
  const double thickness_mm = r.number("wall_thickness", 2 * line_mm);
  p.perimeters = count_of(
      r.number("wall_line_count", std::round(1 + (thickness_mm - p.external_width_mm) / p.perimeter_width_mm)));
  const double skin_mm = r.number("top_bottom_thickness", 0.8);
  p.top_layers = count_of(r.number("top_layers", layers_of(1, r.number("top_thickness", skin_mm), p.layer_mm)));
  p.bottom_layers =
      count_of(r.number("bottom_layers", layers_of(1, r.number("bottom_thickness", skin_mm), p.layer_mm)));
  p.infill_ratio = r.number("infill_sparse_density", 20) / 100;
  p.infill_pattern = r.text("infill_pattern", "grid");
  p.infill_overlap_mm = r.number("infill_overlap_mm", r.number("infill_overlap", 10) / 100 * p.infill_width_mm);
  p.solid_below_mm2 = r.number("min_infill_area", 0);
  p.ensures_shell_thickness = true;
  p.thick_bridges = false;
  p.flow_ratio = r.number("material_flow", 100) / 100;
  p.density_g_per_cm3 = r.number("material_density", 0);
  return p;
}

}  // namespace

std::string find_problem(const PrintProfile& p) {
  for (const auto& [name, value] :
       {std::pair{"layer_mm", p.layer_mm}, std::pair{"first_layer_mm", p.first_layer_mm},
        std::pair{"nozzle_mm", p.nozzle_mm}, std::pair{"external_width_mm", p.external_width_mm},
        std::pair{"perimeter_width_mm", p.perimeter_width_mm}, std::pair{"infill_width_mm", p.infill_width_mm},
        std::pair{"solid_width_mm", p.solid_width_mm}, std::pair{"flow_ratio", p.flow_ratio}})
    if (!(value > 0 && value < 100)) return fmt::format("{} is {} but must be above 0 and below 100", name, value);
  if (!(p.infill_ratio >= 0 && p.infill_ratio <= 1))
    return fmt::format("infill_ratio is {} but must be from 0 to 1", p.infill_ratio);
  if (p.perimeters < 0 || p.perimeters > 1000)
    return fmt::format("perimeters is {} but must be from 0 to 1000", p.perimeters);
  for (const auto& [name, count] : {std::pair{"top_layers", p.top_layers}, std::pair{"bottom_layers", p.bottom_layers}})
    if (count < 0 || count > 1'000'000) return fmt::format("{} is {} but must be from 0 to 1000000", name, count);
  if (!(std::abs(p.infill_overlap_mm) < 100))
    return fmt::format("infill_overlap_mm is {} but must be above -100 and below 100", p.infill_overlap_mm);
  if (!(p.solid_below_mm2 >= 0 && p.solid_below_mm2 <= 1e9))
    return fmt::format("solid_below_mm2 is {} but must be from 0 to 1e9", p.solid_below_mm2);
  if (!(p.density_g_per_cm3 >= 0 && p.density_g_per_cm3 < 30))
    return fmt::format("density_g_per_cm3 is {} but must be at least 0 and below 30", p.density_g_per_cm3);
  return {};
}

Result<PrintProfile> parse_profile(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool is_json = first != text.npos && text[first] == '{';
  const Settings settings = is_json ? settings_in_json(text) : settings_in_lines(text);
  Reader reader(settings);
  const bool is_cura =
      reader.has("infill_sparse_density") || reader.has("wall_line_count") || reader.has("layer_height_0");
  if (!is_cura && !(reader.has("perimeters") && reader.has("fill_density")))
    return fail(ErrorCode::unusable_input,
                "no profile of PrusaSlicer (perimeters, fill_density) and none of Cura (wall_line_count, "
                "infill_sparse_density)");
  const PrintProfile profile = is_cura ? cura_profile(reader) : prusaslicer_profile(reader);
  const std::string problem = reader.problem().empty() ? find_problem(profile) : reader.problem();
  if (!problem.empty()) return fail(ErrorCode::unusable_input, problem);
  return profile;
}

Result<PrintProfile> read_profile(const std::filesystem::path& path) {
  constexpr std::streamoff most_bytes = 1 << 20;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || std::filesystem::is_directory(path))
    return fail(ErrorCode::file_system, path.string() + ": the profile cannot be read");
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(0, size - most_bytes));  // a G-code's settings are its end
  std::string text(most_bytes, '\0');                          // and no more, should it have no end
  file.read(text.data(), most_bytes);
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse_profile(text).map_error([&path](Error error) {
    error.message = path.string() + ": " + error.message;
    return error;
  });
}

}  // namespace aplomb
