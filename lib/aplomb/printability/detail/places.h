#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "aplomb/core/polygon.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/rules.h"

namespace aplomb::detail {

/// Where a measure of the check begins to be a finding of any severity; nothing where the check is not made or has no
/// limit.
std::optional<double> mildest_limit(const Rules& rules, std::string_view id);

/// What a check reports of the places that it measured: those worse than the mildest limit, where their boxes come
/// within reach_mm of each other as one with the worst measure; the single worst if none is. Worst first.
/// \pre mildest_limit(rules, id) has a value; no box is empty.
std::vector<Place> reported(std::vector<Place> measured, const Rules& rules, std::string_view id, double reach_mm);

/// The box of a plane region at a layer, a layer high.
Box3 box_of(const Box2& region_mm, double z_mm, double layer_mm);

}  // namespace aplomb::detail
