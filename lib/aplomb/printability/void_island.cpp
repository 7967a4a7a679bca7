#include "aplomb/printability/void_island.h"

#include <algorithm>

#include "aplomb/adapters/clipper/polygon_operations.h"
#include "aplomb/printability/detail/growth.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {
namespace {

constexpr double least_held_share = 0.25, held_by_rounding = 1e-6;
constexpr double least_island_mm2 = 0.1;  // a dot of a 0.4 mm nozzle

Result<double> common_mm2(const Polygons& a, const Polygons& b) {
  const Result<Polygons> common = adapters::intersection(a, b);
  if (!common) return tl::unexpected(common.error());
  return area_mm2(*common);
}

/// Whether a part of a slice hangs in the void space of the layer below, held by less than a share of it.
Result<bool> is_island(const Slice& slice, const SlicePart& part, const Slice& lower, const Polygons& void_space,
                       double least_share) {
  const double area = part.moments.area_mm2;
  if (area_mm2(void_space) < area / 2) return false;
  if (!slice.outline(part).box_mm.meets(bounding_box(void_space))) return false;
  const Polygons polygons = slice.polygons(part);
  const Result<double> over_void = common_mm2(polygons, void_space);
  if (!over_void) return tl::unexpected(over_void.error());
  if (*over_void <= area / 2) return false;
  const Result<double> held = common_mm2(polygons, lower.material());
  if (!held) return tl::unexpected(held.error());
  return *held < least_share * area;
}

/// The largest slice of what starts with this part, until it is joined to something that stands or that is older.
double grown_mm2(const Slices& slices, const detail::Growth& growth, std::size_t layer, std::size_t part) {
  double largest = slices.layers[layer].parts[part].moments.area_mm2;
  const detail::PrintedSoFar& start = growth.layers[layer][part];
  if (start.contact) return largest;
  for (double area = largest; area > 0 && ++layer < slices.layers.size(); largest = std::max(largest, area)) {
    area = 0;
    for (std::size_t i = 0; i < slices.layers[layer].parts.size(); ++i)
      if (const detail::PrintedSoFar& state = growth.layers[layer][i]; state.body == start.body && !state.contact)
        area += slices.layers[layer].parts[i].moments.area_mm2;
  }
  return largest;
}

}  // namespace

Result<std::vector<Place>> measure_void_island(const PrintedSolid&, const Slices& slices, const Rules& rules,
                                               const Job& job) {
  std::vector<Place> found;
  if (!detail::mildest_limit(rules, "void.island")) return found;
  const bool is_any_hold_enough = rules.process() != Process::sla;
  const double least_share = is_any_hold_enough ? held_by_rounding : least_held_share;
  const Result<std::vector<detail::Links>> links = detail::all_links(slices, job);
  if (!links) return tl::unexpected(links.error());
  const detail::Growth growth = detail::grow(slices, *links);
  for (std::size_t layer = 1; layer < slices.layers.size(); ++layer) {
    if (!job.report(static_cast<double>(layer) / static_cast<double>(slices.layers.size()), "void islands"))
      return cancelled();
    const Slice& slice = slices.layers[layer];
    const Slice& lower = slices.layers[layer - 1];
    if (slice.parts.size() < 2) continue;  // what surrounds the void is one
    const Polygons void_space = lower.void_space();
    if (void_space.empty()) continue;
    for (std::uint32_t i = 0; i < slice.parts.size(); ++i) {
      const SlicePart& part = slice.parts[i];
      if (is_any_hold_enough && std::ranges::find(links->at(layer), i, &detail::Link::first) != links->at(layer).end())
        continue;
      const Result<bool> starts = is_island(slice, part, lower, void_space, least_share);
      if (!starts) return tl::unexpected(starts.error());
      const double area_mm2 = *starts ? grown_mm2(slices, growth, layer, i) : 0;
      if (area_mm2 < least_island_mm2) continue;
      const Vec2 at = part.moments.centroid_mm();
      found.push_back({area_mm2,
                       {at.x, at.y, slice.z_mm},
                       detail::box_of(slice.outline(part).box_mm, slice.z_mm, slices.layer_mm)});
    }
  }
  return detail::reported(std::move(found), rules, "void.island", slices.layer_mm);
}

}  // namespace aplomb
