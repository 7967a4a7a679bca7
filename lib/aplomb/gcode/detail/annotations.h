#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aplomb/gcode/feature.h"

namespace aplomb::detail {

/// Who wrote a program, by what it says of itself.
enum class Slicer { unknown, prusaslicer, orcaslicer, bambustudio, cura };

/// What the settings in a program's comments say of its filaments, by tool.
struct FilamentSettings {
  std::vector<double> diameters_mm, densities_g_per_cm3;
  std::optional<double> used_mm;  ///< what the slicer counted, of all tools
};

/// Follows what slicers write beside the moves: which object, which feature, how high a layer.
///
/// Labels: PrusaSlicer and Orca `; printing object NAME`, Bambu `; start printing object, unique label id: N`, Klipper
/// `EXCLUDE_OBJECT_START NAME=`, Marlin `M486 S`, Cura `;MESH:`. Where several are used, each about the same objects,
/// the first of this list counts.
class Annotations {
 public:
  /// Takes a line that is no move. \return whether the object, feature or layer height may have changed.
  bool note(std::string_view line);

  Feature feature() const { return is_flushing_ ? Feature::purge : feature_; }
  /// Of the object being printed; nothing outside of objects, and where objects have no labels.
  std::optional<std::string_view> object() const;
  /// Of the strokes that follow; nothing where the slicer does not say.
  std::optional<double> layer_height_mm() const { return height_mm_; }
  /// Of the whole print, as Cura says it.
  std::optional<double> usual_height_mm() const { return usual_height_mm_; }

  Slicer slicer() const { return slicer_; }
  const std::string& slicer_name() const { return slicer_name_; }  ///< "PrusaSlicer 2.5.0"; empty where unknown
  bool names_features() const { return names_features_; }
  /// Whether what this slicer writes last, or after the last move, was seen. \pre the slicer is known.
  bool saw_end() const { return saw_end_; }
  const FilamentSettings& filaments() const { return filaments_; }

 private:
  enum Scheme : std::uint8_t { comment, klipper, marlin, mesh, scheme_count };
  bool note_comment(std::string_view text);
  bool note_object(std::string_view text);
  bool note_feature(std::string_view text);
  bool note_height(std::string_view text);
  void note_slicer(std::string_view text);
  void note_setting(std::string_view text);
  bool note_label_command(std::string_view line);
  void enter(Scheme scheme, std::string_view name);
  void leave(Scheme scheme) { labels_[scheme].reset(); }

  std::array<std::optional<std::string>, scheme_count> labels_;
  Scheme best_ = scheme_count;  // of those that were used
  std::map<long, std::string> marlin_names_;
  std::optional<long> marlin_object_;
  Feature feature_ = Feature::unnamed;
  bool is_flushing_ = false, names_features_ = false, saw_end_ = false;
  std::optional<double> height_mm_, usual_height_mm_;
  Slicer slicer_ = Slicer::unknown;
  std::string slicer_name_;
  FilamentSettings filaments_;
};

}  // namespace aplomb::detail
