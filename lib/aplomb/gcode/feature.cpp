#include "aplomb/gcode/feature.h"

#include <algorithm>
#include <string>

namespace aplomb {

Feature feature_named(std::string_view name) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
  const auto has = [&lower](std::string_view word) { return lower.find(word) != std::string::npos; };
  if (has("support") && (has("interface") || has("transition"))) return Feature::support_interface;
  if (has("support") || has("raft")) return Feature::support;
  if (has("skirt") && has("brim")) return Feature::skirt_or_brim;
  if (lower == "skirt") return name == "SKIRT" ? Feature::skirt_or_brim : Feature::skirt;  // Cura's
  if (has("brim")) return Feature::brim;
  if (has("tower")) return Feature::tower;
  if (has("custom")) return Feature::custom;
  if (has("flush") || has("purge")) return Feature::purge;
  return Feature::model;
}

}  // namespace aplomb
