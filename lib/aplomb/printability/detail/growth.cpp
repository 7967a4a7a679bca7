#include "aplomb/printability/detail/growth.h"

#include <algorithm>

#include "aplomb/adapters/clipper/polygon_operations.h"
#include "aplomb/mesh/detail/topology.h"

namespace aplomb::detail {
namespace {

constexpr double least_overlap_mm2 = 1e-6;

bool encloses(const Slice& slice, const SlicePart& part, Vec2 point) {
  const auto is_inside = [&](std::uint32_t loop) {
    return slice.loops[loop].box_mm.holds(point) && aplomb::encloses(slice.loops[loop].points_mm, point);
  };
  return is_inside(part.loops.front()) && std::none_of(part.loops.begin() + 1, part.loops.end(), is_inside);
}

/// Whether one of a few points on the rim of `a` lies in `b`: quick, and nearly always so where they overlap.
bool reaches_into(const Slice& slice_a, const SlicePart& a, const Slice& slice_b, const SlicePart& b) {
  const Polygon& rim = slice_a.outline(a).points_mm;
  const std::size_t step = std::max<std::size_t>(1, rim.size() / 8);
  for (std::size_t i = 0; i < rim.size(); i += step)
    if (encloses(slice_b, b, rim[i])) return true;
  return false;
}

Result<bool> overlap(const Slice& slice_a, const SlicePart& a, const Slice& slice_b, const SlicePart& b) {
  if (!slice_a.outline(a).box_mm.meets(slice_b.outline(b).box_mm)) return false;
  if (reaches_into(slice_a, a, slice_b, b) || reaches_into(slice_b, b, slice_a, a)) return true;
  const Result<Polygons> common = adapters::intersection(slice_a.polygons(a), slice_b.polygons(b));
  if (!common) return tl::unexpected(common.error());
  return area_mm2(*common) > least_overlap_mm2;
}

/// Two bodies by their roots: what they carry, united at the root that stays.
struct Body {
  Moments moments;
  std::optional<std::uint32_t> contact{};
};

class Printer {
 public:
  Printer(const Slices& slices, const std::vector<Links>& links)
      : slices_(slices), links_(links), numbers_(slices), sets_(numbers_.count()), bodies_(numbers_.count()) {}

  Growth print() {
    for (std::size_t layer = 0; layer < slices_.layers.size(); ++layer) add(layer);
    return std::move(growth_);
  }

 private:
  void add(std::size_t layer) {
    const Slice& slice = slices_.layers[layer];
    for (std::size_t part = 0; part < slice.parts.size(); ++part) {
      Body& body = bodies_[numbers_.of(layer, part)];
      body.moments = layer_moments(slice.parts[part], slice.z_mm, slices_.layer_mm);
      if (layer > 0) continue;
      body.contact = static_cast<std::uint32_t>(growth_.contacts.size());
      growth_.contacts.push_back({static_cast<std::uint32_t>(part)});
    }
    for (const auto& [upper, lower] : links_[layer]) join(numbers_.of(layer, upper), numbers_.of(layer - 1, lower));
    std::vector<PrintedSoFar>& states = growth_.layers.emplace_back();
    for (std::size_t part = 0; part < slice.parts.size(); ++part) {
      const std::uint32_t root = sets_.find(numbers_.of(layer, part));
      states.push_back({root, bodies_[root].moments, bodies_[root].contact});
    }
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = sets_.find(a);
    b = sets_.find(b);
    if (a == b) return;
    sets_.join(a, b);
    Body& kept = bodies_[sets_.find(a)];
    kept = {bodies_[a].moments + bodies_[b].moments, united(bodies_[a].contact, bodies_[b].contact)};
  }

  std::optional<std::uint32_t> united(std::optional<std::uint32_t> a, std::optional<std::uint32_t> b) {
    if (!a || !b) return a ? a : b;
    std::vector<std::uint32_t> both = growth_.contacts[*a];
    both.insert(both.end(), growth_.contacts[*b].begin(), growth_.contacts[*b].end());
    std::ranges::sort(both);
    growth_.contacts.push_back(std::move(both));
    return static_cast<std::uint32_t>(growth_.contacts.size() - 1);
  }

  const Slices& slices_;
  const std::vector<Links>& links_;
  PartNumbers numbers_;
  DisjointSets sets_;
  std::vector<Body> bodies_;  // by root
  Growth growth_;
};

}  // namespace

Result<Links> links_between(const Slice& upper, const Slice& lower) {
  Links links;
  for (std::uint32_t a = 0; a < upper.parts.size(); ++a)
    for (std::uint32_t b = 0; b < lower.parts.size(); ++b) {
      const Result<bool> rests = overlap(upper, upper.parts[a], lower, lower.parts[b]);
      if (!rests) return tl::unexpected(rests.error());
      if (*rests) links.emplace_back(a, b);
    }
  return links;
}

Result<std::vector<Links>> all_links(const Slices& slices, const Job& job) {
  std::vector<Links> all(slices.layers.size());
  for (std::size_t layer = 1; layer < all.size(); ++layer) {
    if (layer % 16 == 0 && !job.report(static_cast<double>(layer) / static_cast<double>(all.size()), "layers"))
      return cancelled();
    Result<Links> links = links_between(slices.layers[layer], slices.layers[layer - 1]);
    if (!links) return tl::unexpected(links.error());
    all[layer] = std::move(*links);
  }
  return all;
}

PartNumbers::PartNumbers(const Slices& slices) : firsts_{0} {
  for (const Slice& slice : slices.layers)
    firsts_.push_back(firsts_.back() + static_cast<std::uint32_t>(slice.parts.size()));
}

Moments layer_moments(const SlicePart& part, double z_mm, double layer_mm) {
  const PlaneMoments& m = part.moments;
  return layer_mm * Moments{m.area_mm2, {m.first_mm3.x, m.first_mm3.y, m.area_mm2 * z_mm}};
}

Growth grow(const Slices& slices, const std::vector<Links>& links) { return Printer(slices, links).print(); }

}  // namespace aplomb::detail
