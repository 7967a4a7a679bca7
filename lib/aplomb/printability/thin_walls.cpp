#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/core/pulse.h"
#include "aplomb/printability/detail/spots.h"
#include "aplomb/printability/detail/surface_samples.h"
#include "aplomb/printability/walls.h"

namespace aplomb {
namespace {

using adapters::SurfaceDistance;
using detail::SurfaceSample;

constexpr std::size_t most_samples = 250'000;
constexpr std::size_t batch = 1 << 14;            // between two looks at the job
constexpr double spacing_ratio = 0.4;             // of the limit
constexpr double least_spot_ratio = 4;            // of the limit squared
constexpr double opposite_cos = 0.9396926207859;  // cos(20 degrees)
constexpr std::size_t few_samples = 8192;         // for what passes by far

/// Finds how thick the solid is at samples of its surface.
class Thickness {
 public:
  explicit Thickness(const TriangleMesh& mesh) : mesh_(mesh), distance_(mesh) {}

  /// At every stride-th sample; infinite where it is not below `below_mm`. Nothing when the job stops.
  std::optional<std::vector<SurfaceDistance::Pinch>> measure(const std::vector<SurfaceSample>& samples,
                                                             std::size_t stride, double below_mm,
                                                             const Job& job) const {
    std::vector<SurfaceDistance::Pinch> found(samples.size());
    for (std::size_t begin = 0; begin < samples.size(); begin += batch) {
      if (!job.report(double(begin) / double(samples.size()), "measure thin walls")) return std::nullopt;
      const std::size_t end = std::min(begin + batch, samples.size());
      tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
          if (i % stride == 0)
            found[i] = distance_.pinch(samples[i].point_mm, inward(samples[i].triangle), 0.5 * below_mm, opposite_cos);
      });
    }
    return found;
  }

  /// Whether the straight way from a sample to where its ball touches the other side stays in the solid: the ball may
  /// reach out through a side wall and find a neighbour's back.
  bool is_across(const SurfaceSample& sample, const SurfaceDistance::Pinch& pinch) const {
    const Vec3 centre = sample.point_mm + pinch.radius_mm * inward(sample.triangle);
    const auto nearest = distance_.closest(centre, pinch.triangle);
    if (nearest.distance_mm >= 0.99 * pinch.radius_mm) return true;
    const Vec3 chord = pinch.at_mm - sample.point_mm;
    constexpr double end = 0.05;  // of the chord: too near the surface to tell
    for (double share = end; share < 1 - end;) {
      const Vec3 point = sample.point_mm + share * chord;
      const auto here = distance_.closest(point, pinch.triangle);
      if (!distance_.inside(point, here)) return false;
      share += std::max(0.02, here.distance_mm / norm(chord));
    }
    return true;
  }

  Place place(const SurfaceSample& sample, const SurfaceDistance::Pinch& pinch) const {
    Place place{2 * pinch.radius_mm, 0.5 * (sample.point_mm + pinch.at_mm), detail::box_of(sample.point_mm)};
    place.box_mm.add(pinch.at_mm);
    return place;
  }

 private:
  Vec3 inward(std::uint32_t triangle) const {
    const Triangle& t = mesh_.triangles[triangle];
    const Vec3 a = mesh_.vertices[t[0]];
    return -normalized(cross(mesh_.vertices[t[1]] - a, mesh_.vertices[t[2]] - a));
  }

  const TriangleMesh& mesh_;
  const SurfaceDistance distance_;
};

/// The spots of thin samples that are more than slivers, least first. Nothing when the job stops.
std::optional<std::vector<Place>> thin_spots(const Thickness& thickness, const detail::SurfaceSamples& surface,
                                             const std::vector<SurfaceDistance::Pinch>& pinches, double limit_mm,
                                             const Job& job) {
  std::vector<std::uint32_t> thin;
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < pinches.size(); ++i) {
    if (i % 1024 == 0 && !job.report(0.5, "measure thin walls")) return std::nullopt;
    if (2 * pinches[i].radius_mm < limit_mm && thickness.is_across(surface.samples[i], pinches[i])) {
      thin.push_back(i);
      points.push_back(surface.samples[i].point_mm);
    }
  }
  std::vector<Place> spots;
  const Pulse pulse(job, 0.5, "measure thin walls");
  const auto groups = detail::groups_within(points, std::max(limit_mm, 2 * surface.spacing_mm), pulse);
  if (pulse.stopped()) return std::nullopt;
  for (const auto& group : groups) {
    Place spot;
    spot.measured = std::numeric_limits<double>::infinity();
    double area = 0;
    for (const std::uint32_t n : group) {
      const Place place = thickness.place(surface.samples[thin[n]], pinches[thin[n]]);
      area += surface.samples[thin[n]].area_mm2;
      if (place.measured < spot.measured) spot.measured = place.measured, spot.at_mm = place.at_mm;
      spot.box_mm.add(place.box_mm.min);
      spot.box_mm.add(place.box_mm.max);
    }
    if (area >= least_spot_ratio * limit_mm * limit_mm) spots.push_back(spot);
  }
  std::ranges::stable_sort(spots, {}, &Place::measured);
  return spots;
}

/// The least that is not below the limit.
Result<std::optional<Place>> least_that_passes(const Thickness& thickness, const std::vector<SurfaceSample>& samples,
                                               const std::vector<SurfaceDistance::Pinch>& pinches, double limit_mm,
                                               const Job& job) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < pinches.size(); ++i)
    if (std::isfinite(pinches[i].radius_mm) && 2 * pinches[i].radius_mm >= limit_mm) order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return pinches[i].radius_mm; });
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n % 256 == 0 && !job.report(0.5, "measure thin walls")) return cancelled();
    const std::uint32_t i = order[n];
    if (thickness.is_across(samples[i], pinches[i])) return std::optional(thickness.place(samples[i], pinches[i]));
  }
  return std::optional<Place>();
}

}  // namespace

Result<std::vector<Place>> wall_thin(const PrintedSolid& printed, const Rules& rules, const Job& job) {
  std::vector<Place> places;
  const auto limit = detail::mildest_limit(rules, "wall.thin");
  if (!limit || printed.outer.triangles.empty()) return places;
  const double diagonal = bounding_box(printed.outer).diagonal();
  const double limit_mm = std::max(*limit, 1e-4 * diagonal);
  const Pulse pulse(job, 0, "measure thin walls");
  const auto surface = detail::sample_surface(printed.outer, spacing_ratio * limit_mm, most_samples, pulse);
  if (pulse.stopped()) return cancelled();
  const Thickness thickness(printed.outer);
  const std::size_t stride = 1 + surface.samples.size() / few_samples;
  double below = 2 * limit_mm;
  const auto pinches = thickness.measure(surface.samples, 1, below, job.part(0, 0.5));
  if (!pinches) return cancelled();
  if (*limit > 0) {
    auto spots = thin_spots(thickness, surface, *pinches, limit_mm, job);
    if (!spots) return cancelled();
    if (!spots->empty()) return std::move(*spots);
  }
  auto least = least_that_passes(thickness, surface.samples, *pinches, limit_mm, job);
  while (least && !*least && below < 2 * diagonal) {
    const double above = below;
    below *= 2;
    const auto wider = thickness.measure(surface.samples, stride, below, job.part(0.5, 1));
    if (!wider) return cancelled();
    least = least_that_passes(thickness, surface.samples, *wider, above, job);
  }
  if (!least) return tl::unexpected(least.error());
  if (*least) places.push_back(**least);
  return places;
}

}  // namespace aplomb
