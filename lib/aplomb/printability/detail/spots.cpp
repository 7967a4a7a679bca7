#include "aplomb/printability/detail/spots.h"

#include <algorithm>

#include "aplomb/printability/detail/surface_samples.h"

namespace aplomb::detail {

std::vector<Place> least_of_spots(const std::vector<Place>& places, double reach_mm) {
  std::vector<Vec3> points;
  points.reserve(places.size());
  for (const Place& place : places) points.push_back(place.at_mm);
  std::vector<Place> spots;
  for (const auto& group : groups_within(points, reach_mm)) {
    Place spot = places[group.front()];
    for (const std::uint32_t i : group) {
      if (places[i].measured < spot.measured) spot.measured = places[i].measured, spot.at_mm = places[i].at_mm;
      spot.box_mm.add(places[i].box_mm.min);
      spot.box_mm.add(places[i].box_mm.max);
    }
    spots.push_back(spot);
  }
  std::ranges::stable_sort(spots, {}, &Place::measured);
  return spots;
}

}  // namespace aplomb::detail
