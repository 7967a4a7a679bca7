#include "aplomb/printability/detail/places.h"

#include <algorithm>
#include <cassert>

#include "aplomb/mesh/detail/topology.h"

namespace aplomb::detail {
namespace {

const CheckRule& rule_of(std::string_view id) {
  const auto found = std::ranges::find(check_rules(), id, &CheckRule::id);
  assert(found != check_rules().end());
  return *found;
}

bool are_near(const Box3& a, const Box3& b, double reach_mm) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.min[axis] - reach_mm > b.max[axis] || b.min[axis] - reach_mm > a.max[axis]) return false;
  return true;
}

/// Places by what is near what, the worst of each group first in its own group. \pre Sorted worst first.
std::vector<Place> merged(const std::vector<Place>& places, double reach_mm) {
  std::vector<std::uint32_t> upward(places.size());
  std::iota(upward.begin(), upward.end(), 0U);
  std::ranges::stable_sort(upward, {}, [&](std::uint32_t i) { return places[i].box_mm.min.z; });
  DisjointSets groups(places.size());
  std::vector<std::uint32_t> open;  // those that what follows may still be near to
  for (const std::uint32_t i : upward) {
    const Box3& box = places[i].box_mm;
    std::erase_if(open, [&](std::uint32_t j) { return places[j].box_mm.max.z + reach_mm < box.min.z; });
    for (const std::uint32_t j : open)
      if (are_near(box, places[j].box_mm, reach_mm)) groups.join(i, j);
    open.push_back(i);
  }
  std::vector<Place> spots;
  std::vector<std::size_t> spot_of(places.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const std::uint32_t first = groups.find(i);
    if (first == i) {
      spot_of[i] = spots.size();
      spots.push_back(places[i]);
      continue;
    }
    Box3& box = spots[spot_of[first]].box_mm;
    box.add(places[i].box_mm.min);
    box.add(places[i].box_mm.max);
  }
  return spots;
}

}  // namespace

std::optional<double> mildest_limit(const Rules& rules, std::string_view id) {
  const std::optional<Limits> limits = rules.limits(id);
  if (!limits) return std::nullopt;
  const bool is_least = rule_of(id).is_least;
  std::optional<double> mildest;
  for (const std::optional<double>& limit : {limits->info, limits->warn, limits->fail})
    if (limit && (!mildest || (is_least ? *limit > *mildest : *limit < *mildest))) mildest = limit;
  return mildest;
}

std::vector<Place> reported(std::vector<Place> measured, const Rules& rules, std::string_view id, double reach_mm) {
  const bool is_least = rule_of(id).is_least;
  const double limit = *mildest_limit(rules, id);
  const auto is_worse = [&](double a, double b) { return is_least ? a < b : a > b; };
  std::ranges::stable_sort(measured, is_worse, &Place::measured);
  const auto good = std::ranges::find_if(measured, [&](const Place& p) { return !is_worse(p.measured, limit); });
  if (good != measured.begin()) measured.erase(good, measured.end());
  else if (!measured.empty()) measured.resize(1);
  return merged(measured, reach_mm);
}

Box3 box_of(const Box2& region_mm, double z_mm, double layer_mm) {
  return {{region_mm.min.x, region_mm.min.y, z_mm - layer_mm / 2},
          {region_mm.max.x, region_mm.max.y, z_mm + layer_mm / 2}};
}

}  // namespace aplomb::detail
