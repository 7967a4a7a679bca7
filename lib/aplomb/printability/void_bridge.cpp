#include "aplomb/printability/void_bridge.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "aplomb/adapters/clipper/polygon_operations.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {
namespace {

constexpr double longest_step_mm = 0.5, tolerance_mm = 2e-4;
constexpr double precision_mm = 2.5e-4;  // of a distance; a span is two
constexpr double least_area_mm2 = 1e-8;  // less is rounding

/// The sides of a region that may be the nearest to a point of the box.
std::vector<Segment> sides_near(const Box2& box, const Polygons& rim) {
  const Vec2 middle = 0.5 * (box.min + box.max);
  std::vector<Segment> sides;
  for (const Polygon& loop : rim)
    for (std::size_t i = 0; i < loop.size(); ++i) sides.push_back({loop[i == 0 ? loop.size() - 1 : i - 1], loop[i]});
  const double reach_mm = distance_mm(middle, sides) + norm(box.max - box.min);
  std::erase_if(sides, [&](const Segment& side) { return distance_mm(middle, side) > reach_mm; });
  return sides;
}

/// No point of the piece is farther from the rim of a region that holds it. Distances grow no faster than one walks:
/// along an edge up to the mean of what they are at its ends and its length, inward by the piece's inradius.
double most_distance_mm(const Polygons& piece, const Polygons& rim) {
  double most = 0;
  const std::vector<Segment> sides = sides_near(bounding_box(piece), rim);
  for (const Polygon& loop : piece) {
    double before = distance_mm(loop.back(), sides);
    Vec2 from = loop.back();
    for (const Vec2 to : loop) {
      const double here = distance_mm(to, sides);
      most = std::max(most, (before + here + norm(to - from)) / 2);
      before = here, from = to;
    }
  }
  return most + std::sqrt(area_mm2(piece) / std::numbers::pi) + 10 * tolerance_mm;
}

/// The part of a region within reach of a box.
Result<Polygons> cropped(const Polygons& region, Box2 box, double reach_mm) {
  const Vec2 low{box.min.x - reach_mm, box.min.y - reach_mm}, high{box.max.x + reach_mm, box.max.y + reach_mm};
  return adapters::intersection(region, {{low, {high.x, low.y}, high, {low.x, high.y}}});
}

/// A region, and what is left of it farther from its rim than a depth. Clipper's inset makes a spike of the inset's
/// length at every corner and all of them cross, so a deep one is made of short ones: erosion by balls adds up.
struct Core {
  double depth_mm = 0;
  Polygons region;

  Result<Core> deeper(double by_mm) const {
    Result<Polygons> inner = adapters::grown(region, -by_mm, tolerance_mm);
    if (!inner) return tl::unexpected(inner.error());
    return Core{depth_mm + by_mm, std::move(*inner)};
  }
};

/// A connected ceiling without support, at the layer above what it spans.
class Span {
 public:
  /// \pre The piece is what of the core has material above it.
  Span(Core core, Polygons piece) : core_(std::move(core)), piece_(std::move(piece)), left_(piece_) {}

  /// The largest distance from a point of the piece to support, and that point; nothing if it is below least_mm.
  Result<std::optional<Place>> farthest(double least_mm) {
    const double first_mm = core_.depth_mm;
    double high = first_mm;
    for (bool is_left = true; is_left;) {
      high = core_.depth_mm + std::clamp(core_.depth_mm / 2, first_mm, std::max(first_mm, longest_step_mm));
      const Result<bool> reached = reach(high);
      if (!reached) return tl::unexpected(reached.error());
      is_left = *reached;
    }
    if (high < least_mm) return std::nullopt;
    while (high - core_.depth_mm > precision_mm) {
      const double middle = (core_.depth_mm + high) / 2;
      const Result<bool> reached = reach(middle);
      if (!reached) return tl::unexpected(reached.error());
      if (!*reached) high = middle;
    }
    const Vec2 at = left_.front().front();
    return Place{2 * core_.depth_mm, {at.x, at.y, 0}, {}};
  }

 private:
  /// Whether any of the piece is as far from support; if so, the core is that deep from now on.
  Result<bool> reach(double depth_mm) {
    Result<Core> core = core_.deeper(depth_mm - core_.depth_mm);
    if (!core) return tl::unexpected(core.error());
    Result<Polygons> left = adapters::intersection(core->region, piece_);
    if (!left) return tl::unexpected(left.error());
    if (!(area_mm2(*left) > least_area_mm2)) return false;
    core_ = std::move(*core);
    left_ = std::move(*left);
    return true;
  }

  Core core_;
  Polygons piece_, left_;
};

/// The smallest distance that is still worth finding: that of the mildest limit, or of the worst place so far.
double least_distance_mm(double limit_mm, const std::vector<Place>& found) {
  double worst_mm = 0;
  for (const Place& place : found) worst_mm = std::max(worst_mm, place.measured);
  return std::min(limit_mm, worst_mm) / 2;
}

/// A ceiling still to be measured, and what it cannot be beyond.
struct Candidate {
  std::size_t layer = 0;
  Polygons piece;
  double most_mm = 0;
};

/// Appends the ceilings of a layer over the voids of the layer below it.
Result<void> append_candidates(const Slices& slices, std::size_t layer, double overhang_mm,
                               std::vector<Candidate>& candidates) {
  const Slice& slice = slices.layers[layer];
  const Polygons void_below = slices.layers[layer - 1].void_space();
  if (void_below.empty()) return {};
  const Result<Core> core = Core{0, void_below}.deeper(overhang_mm);
  if (!core) return tl::unexpected(core.error());
  Result<Polygons> free = adapters::difference(core->region, slice.void_space());
  if (free && area_mm2(*free) > least_area_mm2)  // a ceiling thinner than a layer may leave open air there
    free = adapters::intersection(*free, slice.material());
  if (!free) return tl::unexpected(free.error());
  for (Polygons& piece : pieces(*free)) {
    if (!(area_mm2(piece) > least_area_mm2)) continue;
    const double most_mm = most_distance_mm(piece, void_below);
    candidates.push_back({layer, std::move(piece), most_mm});
  }
  return {};
}

/// The candidate's span, unless it is below 2 least_mm.
Result<std::optional<Place>> span_of(const Candidate& candidate, const Slices& slices, double overhang_mm,
                                     double least_mm) {
  const Box2 box = bounding_box(candidate.piece);
  const auto near = cropped(slices.layers[candidate.layer - 1].void_space(), box, candidate.most_mm + overhang_mm);
  if (!near) return tl::unexpected(near.error());
  Result<Core> core = Core{0, *near}.deeper(overhang_mm);
  if (!core) return tl::unexpected(core.error());
  auto place = Span(std::move(*core), candidate.piece).farthest(least_mm);
  if (!place || !*place) return place;
  const double z_mm = slices.layers[candidate.layer].z_mm;
  (*place)->at_mm.z = z_mm;
  (*place)->box_mm = detail::box_of(box, z_mm, slices.layer_mm);
  return place;
}

}  // namespace

Result<std::vector<Place>> measure_void_bridge(const PrintedSolid&, const Slices& slices, const Rules& rules,
                                               const Job& job) {
  const std::optional<double> limit = detail::mildest_limit(rules, "void.bridge");
  if (!limit) return std::vector<Place>{};
  const double slope_deg = std::clamp(detail::mildest_limit(rules, "void.slope").value_or(45), 1.0, 89.0);
  const double overhang_mm = slices.layer_mm / std::tan(slope_deg * std::numbers::pi / 180);
  std::vector<Candidate> candidates;
  const std::size_t layers = slices.layers.size();
  for (std::size_t layer = layers; layer-- > 1;) {
    if (!job.report(static_cast<double>(layers - layer) / static_cast<double>(layers), "void bridges"))
      return cancelled();
    const Result<void> done = append_candidates(slices, layer, overhang_mm, candidates);
    if (!done) return tl::unexpected(done.error());
  }
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::most_mm);  // the widest spare the rest
  std::vector<Place> found;
  for (const Candidate& candidate : candidates) {
    if (!job.report(1, "void bridges")) return cancelled();
    const double least_mm = least_distance_mm(*limit, found);
    if (candidate.most_mm < least_mm) break;
    const Result<std::optional<Place>> place = span_of(candidate, slices, overhang_mm, least_mm);
    if (!place) return tl::unexpected(place.error());
    if (*place) found.push_back(**place);
  }
  return detail::reported(std::move(found), rules, "void.bridge", slices.layer_mm);
}

}  // namespace aplomb
