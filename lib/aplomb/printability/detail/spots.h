#pragma once

#include <vector>

#include "aplomb/printability/detail/places.h"
#include "aplomb/printability/finding.h"

namespace aplomb::detail {

/// A box round one point.
inline Box3 box_of(Vec3 point) {
  Box3 box;
  box.add(point);
  return box;
}

/// Joins places within reach_mm of each other to one, with the least measure and the place of it; least first.
std::vector<Place> least_of_spots(const std::vector<Place>& places, double reach_mm);

}  // namespace aplomb::detail
