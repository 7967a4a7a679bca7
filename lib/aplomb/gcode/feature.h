#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace aplomb {

/// What a slicer lays material down for.
enum class Feature {
  model,
  unnamed,  ///< nothing said what for
  support,
  support_interface,
  skirt_or_brim,  ///< PrusaSlicer and Cura have one name for both
  skirt,
  brim,
  tower,
  purge,   ///< flushed while filaments are changed
  custom,  ///< start, end and other G-code of the printer's profile
};
inline constexpr std::size_t feature_count = 10;
/// In its order.
inline constexpr std::array<std::string_view, feature_count> feature_names{
    "model", "unnamed",     "support", "support interface", "skirt or brim", "skirt",
    "brim",  "prime tower", "purge",   "custom G-code"};

/// Whether a raft, brim or skirt lies on the bed around the model.
constexpr bool is_skirt_or_brim(Feature feature) {
  return feature == Feature::skirt_or_brim || feature == Feature::skirt || feature == Feature::brim;
}

/// By a slicer's own name, such as "Support material interface", "WALL-OUTER" or "Prime tower"; what is none of the
/// others is the model's.
Feature feature_named(std::string_view name);

}  // namespace aplomb
