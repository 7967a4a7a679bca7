#pragma once

#include <optional>
#include <vector>

#include "aplomb/printability/finding.h"
#include "aplomb/printability/rules.h"

namespace aplomb::detail {

/// The first limit that a measure that worsens meets; nothing where there is no check. \pre id names a check.
std::optional<double> mildest_limit(const Rules& rules, std::string_view id);

/// A box round one point.
inline Box3 box_of(Vec3 point) {
  Box3 box;
  box.add(point);
  return box;
}

/// Joins places within reach_mm of each other to one, with the least measure and the place of it; least first.
std::vector<Place> least_of_spots(const std::vector<Place>& places, double reach_mm);

}  // namespace aplomb::detail
