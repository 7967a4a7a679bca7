#pragma once

#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>

#include "aplomb/core/error.h"

namespace aplomb {

/// How a slicer fills a solid. Widths are those of beads as wide as they are told to be; zeros and shares are resolved.
struct PrintProfile {
  enum class Rules { prusaslicer, cura };  ///< where skins go, and how beads share a wall
  Rules rules = Rules::prusaslicer;
  double layer_mm = 0.3, first_layer_mm = 0.35, nozzle_mm = 0.4;
  int perimeters = 3;
  double external_width_mm = 0.45, perimeter_width_mm = 0.45, infill_width_mm = 0.45, solid_width_mm = 0.45;
  int top_layers = 3, bottom_layers = 3;
  double infill_ratio = 0.2;  ///< in [0, 1]
  std::string infill_pattern = "stars";
  double infill_overlap_mm = 0.1;  ///< of infill over the walls, laid twice
  double solid_below_mm2 = 70;     ///< a core with a smaller section is filled
  bool ensures_shell_thickness = false;
  bool thick_bridges = true;
  double flow_ratio = 1;
  double density_g_per_cm3 = 0;  ///< of the filament; 0: not said

  /// Between the widths of beads with round sides and their spacing: PrusaSlicer's (1 - pi/4) of a layer.
  double bead_gap_mm() const { return rules == Rules::prusaslicer ? (1 - std::numbers::pi / 4) * layer_mm : 0; }
};

/// A sentence that names the field, its value and its range, or nothing.
std::string find_problem(const PrintProfile& profile);

/// Reads a profile: an .ini of PrusaSlicer or SuperSlicer, the settings in the comments of its G-code, or Cura's
/// settings as JSON ({"layer_height": 0.2}) or "layer_height = 0.2" lines (.inst.cfg, .curaprofile's parts). What is
/// not said is the slicer's own default.
///
/// \return file_system; unusable_input for what holds no such settings, or one that makes no sense, by its name.
Result<PrintProfile> read_profile(const std::filesystem::path& path);
Result<PrintProfile> parse_profile(std::string_view text);

}  // namespace aplomb
