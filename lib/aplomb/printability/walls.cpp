#include "aplomb/printability/walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/printability/detail/spots.h"
#include "aplomb/printability/detail/surface_samples.h"
#include "aplomb/shell/wall.h"

namespace aplomb {
namespace {

using adapters::SurfaceDistance;

constexpr std::size_t most_samples = 100'000;
constexpr std::size_t batch = 1 << 12;  // between two looks at the job

/// Samples of the triangles of `inner` that were found thin, with how far they are from `outer`.
std::optional<std::vector<Place>> thin_samples(const TriangleMesh& inner, const TriangleMesh& outer,
                                               const WallMeasure& wall, double spacing_mm, const Job& job) {
  std::vector<bool> is_thin(inner.triangles.size(), wall.thin.empty());
  for (const std::uint32_t t : wall.thin) is_thin[t] = true;
  const TriangleMesh thin = detail::submesh(inner, [&](std::size_t t) { return is_thin[t]; });
  const SurfaceDistance distance(outer);
  std::vector<Vec3> points = thin.vertices;
  for (const auto& sample : detail::sample_surface(thin, spacing_mm, most_samples).samples)
    points.push_back(sample.point_mm);
  std::vector<Place> places;
  std::uint32_t hint = SurfaceDistance::no_triangle;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % batch == 0 && !job.report(double(i) / double(points.size()), "measure the walls")) return std::nullopt;
    const auto nearest = distance.closest(points[i], hint);
    hint = nearest.triangle;
    const Vec3 across = distance.closest_point(points[i], nearest.triangle);
    Place place{nearest.distance_mm, 0.5 * (points[i] + across), detail::box_of(points[i])};
    place.box_mm.add(across);
    places.push_back(place);
  }
  return places;
}

/// The spots of one wall, with the exact least distance as the worst.
Result<std::vector<Place>> wall_spots(const TriangleMesh& inner, const TriangleMesh& outer, double limit_mm,
                                      const Job& job) {
  const auto wall = measure_wall(inner, outer, std::max(0.0, limit_mm), job.part(0, 0.7));
  if (!wall) return tl::unexpected(wall.error());
  if (!std::isfinite(wall->least_mm)) return std::vector<Place>{};
  const bool passes = wall->least_mm >= limit_mm;
  const double spacing = 0.25 * (passes ? wall->least_mm : limit_mm);
  auto samples = thin_samples(inner, outer, *wall, spacing, job.part(0.7, 1));
  if (!samples) return cancelled();
  const Place least = *std::ranges::min_element(*samples, {}, &Place::measured);
  std::erase_if(*samples, [&](const Place& place) { return passes || place.measured >= limit_mm; });
  auto spots = detail::least_of_spots(*samples, 4 * spacing);
  if (spots.empty()) spots.push_back(least);
  spots.front().measured = wall->least_mm;
  return spots;
}

/// What is worse than the limit, or the worst alone.
void sort_and_trim(std::vector<Place>& places, double limit_mm) {
  std::ranges::stable_sort(places, {}, &Place::measured);
  const auto passing = std::ranges::find_if(places, [&](const Place& p) { return p.measured >= limit_mm; });
  if (!places.empty()) places.erase(std::max(passing, places.begin() + 1), places.end());
}

}  // namespace

Result<std::vector<Place>> wall_void_outer(const PrintedSolid& printed, const Rules& rules, const Job& job) {
  const auto limit = detail::mildest_limit(rules, "wall.void_outer");
  std::vector<Place> places;
  if (!limit || printed.voids.empty()) return places;
  TriangleMesh voids;
  for (const TriangleMesh& one : printed.voids) voids = joined(std::move(voids), one);
  return wall_spots(voids, printed.outer, *limit, job);
}

Result<std::vector<Place>> wall_void_void(const PrintedSolid& printed, const Rules& rules, const Job& job) {
  const auto limit = detail::mildest_limit(rules, "wall.void_void");
  std::vector<Place> places;
  if (!limit) return places;
  const std::size_t count = printed.voids.size();
  TriangleMesh later;
  for (std::size_t i = count; i-- > 0;) {  // a void and all after it
    const Job part = job.part(double(count - 1 - i) / double(count), double(count - i) / double(count));
    const auto spots = wall_spots(printed.voids[i], later, *limit, part);
    if (!spots) return tl::unexpected(spots.error());
    places.insert(places.end(), spots->begin(), spots->end());
    later = joined(std::move(later), printed.voids[i]);
  }
  sort_and_trim(places, *limit);
  return places;
}

}  // namespace aplomb
