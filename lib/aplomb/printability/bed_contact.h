#pragma once

#include <vector>

#include "aplomb/printability/finding.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/slices.h"

namespace aplomb {

struct BedContact {
  double area_mm2 = 0;  ///< of the first layer
  double width_mm = 0;  ///< the smallest altitude of its convex hull: what it is held by at its narrowest
  Vec2 center_mm;       ///< of the area
  Box2 box_mm;
  std::size_t parts = 0;
};

/// What the first layer's slice touches the plate with. All zero without layers.
BedContact bed_contact(const Slices& slices);

/// "bed.contact": the first layer's area, mm2; one place where the process has the check.
std::vector<Place> measure_bed_contact(const Slices& slices, const Rules& rules);

}  // namespace aplomb
