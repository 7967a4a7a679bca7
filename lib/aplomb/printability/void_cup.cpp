#include "aplomb/printability/void_cup.h"

#include <algorithm>

#include "aplomb/adapters/clipper/polygon_operations.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {
namespace {

constexpr double least_passage_mm2 = 0.025;

/// Empty space of a layer that material surrounds.
struct Pocket {
  Polygons space;
  Box2 box_mm;
  double area_mm2 = 0;
  bool aired = false;     ///< connected with the air through the layers so far
  std::uint32_t cup = 0;  ///< where it is not aired
};

/// The holes of the layer's parts, each without the parts that lie in it.
std::vector<Pocket> pockets_of(const Slice& slice) {
  Polygons space;
  for (const SlicePart& part : slice.parts)
    for (std::size_t i = 1; i < part.loops.size(); ++i) {
      const Polygon& hole = slice.loops[part.loops[i]].points_mm;
      space.emplace_back(hole.rbegin(), hole.rend());
    }
  const std::size_t holes = space.size();
  for (const SlicePart& part : slice.parts) {
    const Polygon& outline = slice.outline(part).points_mm;
    const auto lies_in = [&](const Polygon& hole) { return encloses(hole, outline.front()); };
    if (std::any_of(space.begin(), space.begin() + static_cast<std::ptrdiff_t>(holes), lies_in))
      space.emplace_back(outline.rbegin(), outline.rend());
  }
  std::vector<Pocket> pockets;
  for (Polygons& piece : pieces(space))
    if (const double area = area_mm2(piece); area > least_passage_mm2) pockets.push_back({std::move(piece), {}, area});
  for (Pocket& pocket : pockets) pocket.box_mm = bounding_box(pocket.space);
  return pockets;
}

/// What the material of a layer and the pockets in it take up.
Polygons outlines_of(const Slice& slice) {
  Polygons all;
  for (const SlicePart& part : slice.parts) all.push_back(slice.outline(part).points_mm);
  return all;
}

/// Layers that were printed, and the cups in them.
class CupSearch {
 public:
  explicit CupSearch(double layer_mm) : layer_mm_(layer_mm) {}

  Result<void> add(const Slice& slice) {
    std::vector<Pocket> pockets = pockets_of(slice);
    for (Pocket& pocket : pockets)
      if (Result<void> done = connect(pocket, slice.z_mm); !done) return done;
    pockets_ = std::move(pockets);
    outlines_ = outlines_of(slice);
    is_first_ = false;
    return {};
  }

  /// Every cup of at least that height.
  std::vector<Place> cups(double least_height_mm) {
    std::vector<Place> found;
    for (std::uint32_t i = 0; i < cups_.size(); ++i)
      if (const Place& cup = cups_[i]; sets_[i] == i && cup.box_mm.size().z >= least_height_mm) found.push_back(cup);
    return found;
  }

 private:
  Result<void> connect(Pocket& pocket, double z_mm) {
    pocket.aired = is_first_;  // the plate is taken to be out of the way
    if (!is_first_) {
      const Result<Polygons> in_air = adapters::difference(pocket.space, outlines_);
      if (!in_air) return tl::unexpected(in_air.error());
      pocket.aired = area_mm2(*in_air) > least_passage_mm2;
    }
    std::vector<std::uint32_t> joined;
    for (const Pocket& lower : pockets_) {
      if (pocket.aired || !lower.box_mm.meets(pocket.box_mm)) continue;
      const Result<Polygons> passage = adapters::intersection(pocket.space, lower.space);
      if (!passage) return tl::unexpected(passage.error());
      if (!(area_mm2(*passage) > least_passage_mm2)) continue;
      if (lower.aired) pocket.aired = true;
      else joined.push_back(root(lower.cup));
    }
    if (!pocket.aired) enter(pocket, joined, z_mm);
    return {};
  }

  void enter(Pocket& pocket, std::vector<std::uint32_t> joined, double z_mm) {
    const Vec2 at = plane_center(pocket);
    const Place place{pocket.area_mm2, {at.x, at.y, z_mm}, detail::box_of(pocket.box_mm, z_mm, layer_mm_)};
    if (joined.empty()) {
      pocket.cup = static_cast<std::uint32_t>(cups_.size());
      sets_.push_back(pocket.cup);
      cups_.push_back(place);
      return;
    }
    pocket.cup = std::ranges::min(joined);
    unite(pocket.cup, place);
    for (const std::uint32_t other : joined)
      if (other != pocket.cup) {
        sets_[other] = pocket.cup;
        unite(pocket.cup, cups_[other]);
      }
  }

  void unite(std::uint32_t cup, const Place& place) {
    Place& kept = cups_[cup];
    if (place.measured > kept.measured) {
      kept.measured = place.measured;
      kept.at_mm = place.at_mm;
    }
    kept.box_mm.add(place.box_mm.min);
    kept.box_mm.add(place.box_mm.max);
  }

  static Vec2 plane_center(const Pocket& pocket) {
    PlaneMoments sum;
    for (const Polygon& loop : pocket.space) sum += plane_moments(loop);
    return sum.centroid_mm();
  }

  std::uint32_t root(std::uint32_t cup) const {
    while (sets_[cup] != cup) cup = sets_[cup];
    return cup;
  }

  double layer_mm_;
  bool is_first_ = true;
  Polygons outlines_;            // of the last layer
  std::vector<Pocket> pockets_;  // of the last layer
  std::vector<Place> cups_;
  std::vector<std::uint32_t> sets_;
};

}  // namespace

Result<std::vector<Place>> measure_void_cup(const PrintedSolid&, const Slices& slices, const Rules& rules,
                                            const Job& job) {
  if (!detail::mildest_limit(rules, "void.cup")) return std::vector<Place>{};
  CupSearch search(slices.layer_mm);
  for (std::size_t layer = 0; layer < slices.layers.size(); ++layer) {
    if (!job.report(static_cast<double>(layer) / static_cast<double>(slices.layers.size()), "suction cups"))
      return cancelled();
    if (const Result<void> done = search.add(slices.layers[layer]); !done) return tl::unexpected(done.error());
  }
  return detail::reported(search.cups(rules.number("void.cup_mm")), rules, "void.cup", 0);
}

}  // namespace aplomb
