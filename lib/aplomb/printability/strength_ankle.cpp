#include "aplomb/printability/strength_ankle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "aplomb/mesh/detail/topology.h"
#include "aplomb/printability/detail/growth.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {
namespace {

constexpr double push_n = 10, gravity_m_per_s2 = 9.80665;
constexpr double least_share_above = 0.02;
constexpr double newton_per_mm3_and_density = 1e-6 * gravity_m_per_s2;  // 1 g/cm3 is 1e-6 kg/mm3

/// What is carried, in the frame of the model.
struct Load {
  double weight_n = 0;
  Vec2 center_mm;            // of the weight
  double push_lever_mm = 0;  // 0: no push
};

/// The parts of a layer that carry it.
struct Section {
  std::vector<const SlicePart*> parts;
  PlaneMoments moments;
  double outline_mm2 = 0;  // of the largest part, its holes filled
};

/// The stress of the formula above, and where. \pre The section's area is positive.
Place largest_stress(const Slice& slice, const Section& section, const Load& load) {
  const PlaneMoments j = section.moments.about_centroid();
  const Vec2 center = section.moments.centroid_mm();
  const double determinant = j.xx_mm4 * j.yy_mm4 - j.xy_mm4 * j.xy_mm4;
  const auto solved = [&](Vec2 q) {
    return (1 / determinant) * Vec2{j.yy_mm4 * q.x - j.xy_mm4 * q.y, j.xx_mm4 * q.y - j.xy_mm4 * q.x};
  };
  const Vec2 tilt = load.weight_n * solved(load.center_mm - center);  // stress by weight per mm of q
  const double even = load.weight_n / section.moments.area_mm2;
  Place worst;
  for (const SlicePart* part : section.parts)
    for (const Vec2& point : slice.outline(*part).points_mm) {
      const Vec2 q = point - center;
      const double stress = push_n * load.push_lever_mm * norm(solved(q)) + std::abs(even + dot(tilt, q));
      if (stress > worst.measured) worst = {stress, {point.x, point.y, slice.z_mm}, {}};
    }
  return worst;
}

/// Takes the solid apart from its top down.
class SectionSearch {
 public:
  SectionSearch(const Slices& slices, const std::vector<detail::Links>& links, const detail::Growth& growth,
                double density_g_per_cm3)
      : slices_(slices),
        links_(links),
        growth_(growth),
        numbers_(slices),
        bodies_(numbers_.count()),
        above_(numbers_.count()),
        weights_(numbers_.count()),
        newton_per_mm3_(density_g_per_cm3 * newton_per_mm3_and_density),
        top_of_body_(numbers_.count(), 0) {
    for (std::size_t layer = 0; layer < slices.layers.size(); ++layer)
      for (const auto& [upper, lower] : links[layer])
        bodies_.join(numbers_.of(layer, upper), numbers_.of(layer - 1, lower));
    for (std::uint32_t layer = 0; layer < slices.layers.size(); ++layer) {
      volume_mm3_ += slices.layers[layer].moments().area_mm2 * slices.layer_mm;
      for (std::size_t part = 0; part < slices.layers[layer].parts.size(); ++part)
        top_of_body_[bodies_.find(numbers_.of(layer, part))] = layer;
    }
  }

  std::vector<Place> search() {
    std::vector<Place> found;
    for (std::size_t layer = slices_.layers.size(); layer-- > 0;) {
      join_to_above(layer);
      judge(layer, found);
      for (std::size_t part = 0; part < slices_.layers[layer].parts.size(); ++part)
        weights_[root(layer, part)].moments += moments_of(layer, part);
    }
    return found;
  }

 private:
  struct Above {
    Moments moments;      // of the layers above
    std::size_t top = 0;  // the highest layer
  };

  std::uint32_t root(std::size_t layer, std::size_t part) { return above_.find(numbers_.of(layer, part)); }
  Moments moments_of(std::size_t layer, std::size_t part) const {
    const Slice& slice = slices_.layers[layer];
    return detail::layer_moments(slice.parts[part], slice.z_mm, slices_.layer_mm);
  }

  void join_to_above(std::size_t layer) {
    for (std::size_t part = 0; part < slices_.layers[layer].parts.size(); ++part)
      weights_[numbers_.of(layer, part)].top = layer;
    if (layer + 1 == slices_.layers.size()) return;
    for (const auto& [upper, lower] : links_[layer + 1]) {
      const std::uint32_t a = root(layer + 1, upper), b = root(layer, lower);
      if (a == b) continue;
      above_.join(a, b);
      weights_[above_.find(a)] = {weights_[a].moments + weights_[b].moments,
                                  std::max(weights_[a].top, weights_[b].top)};
    }
  }

  void judge(std::size_t layer, std::vector<Place>& found) {
    const std::size_t parts = slices_.layers[layer].parts.size();
    std::map<std::uint32_t, std::vector<std::uint32_t>> groups;  // of parts that are connected above
    for (std::uint32_t part = 0; part < parts; ++part) groups[root(layer, part)].push_back(part);
    for (const auto& [group, members] : groups) judge(layer, weights_[group], members, found);
  }

  void judge(std::size_t layer, const Above& above, const std::vector<std::uint32_t>& members,
             std::vector<Place>& found) {
    const Slice& slice = slices_.layers[layer];
    Section section;
    Moments carried = above.moments;
    std::set<std::uint32_t> hanging;
    for (const std::uint32_t part : members) {
      const detail::PrintedSoFar& state = growth_.layers[layer][part];
      if (!state.contact) {
        if (hanging.insert(state.body).second) carried += state.moments;
        continue;
      }
      section.parts.push_back(&slice.parts[part]);
      section.moments += slice.parts[part].moments;
      section.outline_mm2 = std::max(section.outline_mm2, slice.outline(slice.parts[part]).moments.area_mm2);
      carried += 0.5 * moments_of(layer, part);  // the layer is cut in its middle
    }
    if (!is_judged(slice, above, section, carried)) return;
    const Vec3 center = carried.centroid_mm();
    const std::uint32_t body = bodies_.find(numbers_.of(layer, members.front()));
    const double lever_mm = above.top == top_of_body_[body] ? top_mm(above) - slice.z_mm : 0;
    Place place =
        largest_stress(slice, section, {carried.volume_mm3 * newton_per_mm3_, {center.x, center.y}, lever_mm});
    Box2 box;
    for (const SlicePart* part : section.parts) {
      box.add(slice.outline(*part).box_mm.min);
      box.add(slice.outline(*part).box_mm.max);
    }
    place.box_mm = detail::box_of(box, slice.z_mm, slices_.layer_mm);
    found.push_back(place);
  }

  double top_mm(const Above& above) const { return slices_.layers[above.top].z_mm + slices_.layer_mm / 2; }

  bool is_judged(const Slice& slice, const Above& above, const Section& section, const Moments& carried) const {
    if (!(section.moments.area_mm2 > 1e-6)) return false;
    const double half_width_mm = std::sqrt(section.outline_mm2 / std::numbers::pi);
    return carried.volume_mm3 >= least_share_above * volume_mm3_ && slice.z_mm - slices_.plate_mm >= half_width_mm &&
           top_mm(above) - slice.z_mm >= half_width_mm;
  }

  const Slices& slices_;
  const std::vector<detail::Links>& links_;
  const detail::Growth& growth_;
  detail::PartNumbers numbers_;
  detail::DisjointSets bodies_;  // connected in the whole solid
  detail::DisjointSets above_;   // connected by the layers so far, from the top
  std::vector<Above> weights_;   // by root of above_
  double newton_per_mm3_;
  double volume_mm3_ = 0;
  std::vector<std::size_t> top_of_body_;  // by root of bodies_
};

}  // namespace

Result<std::vector<Place>> measure_strength_ankle(const PrintedSolid&, const Slices& slices, const Rules& rules,
                                                  double density_g_per_cm3, const Job& job) {
  assert(density_g_per_cm3 > 0);
  if (!detail::mildest_limit(rules, "strength.ankle") || slices.layers.empty()) return std::vector<Place>{};
  const Result<std::vector<detail::Links>> links = detail::all_links(slices, job);
  if (!links) return tl::unexpected(links.error());
  const detail::Growth growth = detail::grow(slices, *links);
  std::vector<Place> found = SectionSearch(slices, *links, growth, density_g_per_cm3).search();
  return detail::reported(std::move(found), rules, "strength.ankle", slices.layer_mm);
}

}  // namespace aplomb
