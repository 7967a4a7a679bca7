#include "aplomb/fdm/print_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "aplomb/fdm/profile_settings.h"

namespace aplomb {
namespace {

using Reader = detail::SettingsReader;

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";

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

/// A switch up to PrusaSlicer 2.6, a choice of "disabled", "partial" and "enabled" since.
bool ensures_shell_thickness(Reader& r) {
  constexpr std::string_view name = "ensure_vertical_shell_thickness";
  const std::string chosen = r.text(name, "0");
  if (chosen == "disabled") return false;
  return chosen == "enabled" || chosen == "partial" || r.number(name, 0) > 0;
}

PrintProfile prusaslicer_profile(Reader& r) {
  PrintProfile p;
  p.nozzle_mm = r.by_tool("nozzle_diameter", 0.4);
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
  p.ensures_shell_thickness = ensures_shell_thickness(r);
  p.thick_bridges = r.number("thick_bridges", 1) > 0;
  p.flow_ratio = r.by_tool("extrusion_multiplier", 1);
  p.density_g_per_cm3 = r.by_tool("filament_density", 0);
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

/// A field out of its range.
struct Problem {
  std::string_view field;
  double value = 0;
  std::string allowed;
};

std::optional<Problem> problem_of(const PrintProfile& p) {
  for (const auto& [name, value] :
       {std::pair{"layer_mm", p.layer_mm}, std::pair{"first_layer_mm", p.first_layer_mm},
        std::pair{"nozzle_mm", p.nozzle_mm}, std::pair{"external_width_mm", p.external_width_mm},
        std::pair{"perimeter_width_mm", p.perimeter_width_mm}, std::pair{"infill_width_mm", p.infill_width_mm},
        std::pair{"solid_width_mm", p.solid_width_mm}, std::pair{"flow_ratio", p.flow_ratio}})
    if (!(value > 0 && value < 100)) return Problem{name, value, "above 0 and below 100"};
  if (!(p.infill_ratio >= 0 && p.infill_ratio <= 1)) return Problem{"infill_ratio", p.infill_ratio, "from 0 to 1"};
  if (p.perimeters < 0 || p.perimeters > 1000)
    return Problem{"perimeters", static_cast<double>(p.perimeters), "from 0 to 1000"};
  for (const auto& [name, count] : {std::pair{"top_layers", p.top_layers}, std::pair{"bottom_layers", p.bottom_layers}})
    if (count < 0 || count > 1'000'000) return Problem{name, static_cast<double>(count), "from 0 to 1000000"};
  if (!(std::abs(p.infill_overlap_mm) < 100))
    return Problem{"infill_overlap_mm", p.infill_overlap_mm, "above -100 and below 100"};
  if (!(p.solid_below_mm2 >= 0 && p.solid_below_mm2 <= 1e9))
    return Problem{"solid_below_mm2", p.solid_below_mm2, "from 0 to 1e9"};
  if (!(p.density_g_per_cm3 >= 0 && p.density_g_per_cm3 < 30))
    return Problem{"density_g_per_cm3", p.density_g_per_cm3, "at least 0 and below 30"};
  return std::nullopt;
}

/// Where a field comes from in a file: settings by rank.
struct Source {
  std::string_view field;
  std::vector<std::string_view> prusaslicer, cura;
};

const std::vector<Source>& sources() {
  static const std::vector<Source> all{
      {"layer_mm", {"layer_height"}, {"layer_height"}},
      {"first_layer_mm", {"first_layer_height"}, {"layer_height_0", "layer_height"}},
      {"nozzle_mm", {"nozzle_diameter"}, {"machine_nozzle_size"}},
      {"external_width_mm",
       {"external_perimeter_extrusion_width", "extrusion_width", "nozzle_diameter"},
       {"wall_line_width_0", "wall_line_width", "line_width", "machine_nozzle_size"}},
      {"perimeter_width_mm",
       {"perimeter_extrusion_width", "extrusion_width", "nozzle_diameter"},
       {"wall_line_width_x", "wall_line_width", "line_width", "machine_nozzle_size"}},
      {"infill_width_mm",
       {"infill_extrusion_width", "extrusion_width", "nozzle_diameter"},
       {"infill_line_width", "line_width", "machine_nozzle_size"}},
      {"solid_width_mm",
       {"solid_infill_extrusion_width", "extrusion_width", "nozzle_diameter"},
       {"skin_line_width", "line_width", "machine_nozzle_size"}},
      {"flow_ratio", {"extrusion_multiplier"}, {"material_flow"}},
      {"infill_ratio", {"fill_density"}, {"infill_sparse_density"}},
      {"perimeters", {"perimeters"}, {"wall_line_count", "wall_thickness"}},
      {"top_layers", {"top_solid_layers"}, {"top_layers", "top_thickness", "top_bottom_thickness"}},
      {"bottom_layers", {"bottom_solid_layers"}, {"bottom_layers", "bottom_thickness", "top_bottom_thickness"}},
      {"infill_overlap_mm", {"infill_overlap"}, {"infill_overlap_mm", "infill_overlap"}},
      {"solid_below_mm2", {"solid_infill_below_area"}, {"min_infill_area"}},
      {"density_g_per_cm3", {"filament_density"}, {"material_density"}}};
  return all;
}

/// The problem in the file's words: its own setting as it stands there, and what that may be.
std::string in_words_of_file(const Problem& problem, const Reader& r, PrintProfile::Rules rules) {
  const auto source = std::ranges::find(sources(), problem.field, &Source::field);
  const bool is_cura = rules == PrintProfile::Rules::cura;
  const std::vector<std::string_view>& names = is_cura ? source->cura : source->prusaslicer;
  std::string allowed = problem.allowed;
  if (problem.field == "infill_ratio") allowed = "from 0 to 100 %";
  if (problem.field == "flow_ratio" && is_cura) allowed = "above 0 and below 10000 %";
  for (const std::string_view name : names)
    if (r.has(name) && r.text(name, "") != "0")
      return fmt::format("{}, which comes to {:g}; it must be {}", r.shown(name), problem.value, allowed);
  return fmt::format("{} comes to {:g}; it must be {}", names.front(), problem.value, allowed);
}

std::string problem_in_file(const PrintProfile& profile, const Reader& reader) {
  if (!reader.problem().empty()) return reader.problem();
  const auto problem = problem_of(profile);
  return problem ? in_words_of_file(*problem, reader, profile.rules) : "";
}

Result<PrintProfile> parse(std::string_view text, std::size_t first_line) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return fail(ErrorCode::unusable_input, "byte 0: the text is UTF-16; save it as UTF-8 or plain ASCII");
  if (text.starts_with(utf8_mark)) text.remove_prefix(utf8_mark.size());
  const detail::Settings settings = detail::settings_of_profile(text, first_line);
  Reader reader(settings);
  const bool is_cura =
      reader.has("infill_sparse_density") || reader.has("wall_line_count") || reader.has("layer_height_0");
  if (!is_cura && !(reader.has("perimeters") && reader.has("fill_density")))
    return fail(ErrorCode::unusable_input,
                fmt::format("no profile of PrusaSlicer (perimeters, fill_density) and none of Cura (wall_line_count, "
                            "infill_sparse_density), in {} settings; export the slicer's configuration",
                            settings.size()));
  const PrintProfile profile = is_cura ? cura_profile(reader) : prusaslicer_profile(reader);
  if (const std::string problem = problem_in_file(profile, reader); !problem.empty())
    return fail(ErrorCode::unusable_input, problem);
  return profile;
}

}  // namespace

std::string find_problem(const PrintProfile& profile) {
  const auto problem = problem_of(profile);
  return problem ? fmt::format("{} is {:g} but must be {}", problem->field, problem->value, problem->allowed) : "";
}

Result<PrintProfile> parse_profile(std::string_view text) { return parse(text, 1); }

Result<PrintProfile> read_profile(const std::filesystem::path& path) {
  constexpr std::streamoff most_bytes = 1 << 20;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || std::filesystem::is_directory(path))
    return fail(ErrorCode::file_system, path.string() + ": the profile cannot be read; check its name");
  const std::streamoff size = file.tellg();
  const bool is_whole = size <= most_bytes;
  file.seekg(std::max<std::streamoff>(0, size - most_bytes));  // a G-code's settings are its end
  std::string text(most_bytes, '\0');                          // and no more, should it have no end
  file.read(text.data(), most_bytes);
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse(text, is_whole ? 1 : 0).map_error([&path](Error error) {
    error.message = path.string() + ": " + error.message;
    return error;
  });
}

}  // namespace aplomb
