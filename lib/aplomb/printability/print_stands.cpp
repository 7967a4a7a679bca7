#include "aplomb/printability/print_stands.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "aplomb/balance/detail/convex_hull_2d.h"
#include "aplomb/balance/support_polygon.h"
#include "aplomb/printability/detail/growth.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {
namespace {

/// What of a convex polygon lies on the inner side of a line moved inward.
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, const SupportEdge& edge, double inward_mm) {
  const auto inside_mm = [&](Vec2 q) { return dot(edge.inward, q - edge.from_mm) - inward_mm; };
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double at_a = inside_mm(a), at_b = inside_mm(b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) kept.push_back(a + (at_a / (at_a - at_b)) * (b - a));
  }
  return kept;
}

/// The hull of a contact and the radius of the largest circle in it.
class Support {
 public:
  explicit Support(std::vector<Vec2> points) {
    hull_.corners_mm = detail::convex_hull(std::move(points));
    edges_ = hull_.edges();
    if (hull_.degenerate()) return;
    double high = hull_.width_mm() / 2;  // no circle is larger
    for (int step = 0; step < 40; ++step) {
      const double middle = (inradius_mm_ + high) / 2;
      (holds_circle(middle) ? inradius_mm_ : high) = middle;
    }
  }

  /// 0 where the contact is too thin to say.
  double share_left(Vec2 center) const {
    double margin = std::numeric_limits<double>::infinity();
    for (const SupportEdge& edge : edges_) margin = std::min(margin, dot(edge.inward, center - edge.from_mm));
    return inradius_mm_ > 0 ? margin / inradius_mm_ : 0;
  }

 private:
  bool holds_circle(double radius_mm) const {
    std::vector<Vec2> centers = hull_.corners_mm;
    for (const SupportEdge& edge : edges_) centers = clipped(centers, edge, radius_mm);
    return !centers.empty();
  }

  SupportPolygon hull_;
  std::vector<SupportEdge> edges_;
  double inradius_mm_ = 0;
};

Support support_of(const Slice& first, const std::vector<std::uint32_t>& parts) {
  std::vector<Vec2> points;
  for (const std::uint32_t part : parts) {
    const Polygon& outline = first.outline(first.parts[part]).points_mm;
    points.insert(points.end(), outline.begin(), outline.end());
  }
  return Support(std::move(points));
}

/// The bodies that a layer belongs to, each once.
void append_shares(const Slice& slice, double layer_mm, const std::vector<detail::PrintedSoFar>& states,
                   const std::vector<std::optional<Support>>& supports, std::vector<Place>& found) {
  for (std::size_t part = 0; part < states.size(); ++part) {
    const detail::PrintedSoFar& state = states[part];
    const auto is_same = [&](const detail::PrintedSoFar& other) { return other.body == state.body; };
    if (!state.contact || std::any_of(states.begin(), states.begin() + static_cast<std::ptrdiff_t>(part), is_same))
      continue;
    Box2 box;
    for (std::size_t i = part; i < states.size(); ++i)
      if (is_same(states[i])) {
        box.add(slice.outline(slice.parts[i]).box_mm.min);
        box.add(slice.outline(slice.parts[i]).box_mm.max);
      }
    const Vec3 center = state.moments.centroid_mm();
    const double share = supports[*state.contact]->share_left({center.x, center.y});
    found.push_back({share, {center.x, center.y, slice.z_mm}, detail::box_of(box, slice.z_mm, layer_mm)});
  }
}

}  // namespace

Result<std::vector<Place>> measure_print_stands(const PrintedSolid&, const Slices& slices, const Rules& rules,
                                                const Job& job) {
  std::vector<Place> found;
  if (!detail::mildest_limit(rules, "print.stands") || slices.layers.empty()) return found;
  const Result<std::vector<detail::Links>> links = detail::all_links(slices, job);
  if (!links) return tl::unexpected(links.error());
  const detail::Growth growth = detail::grow(slices, *links);
  std::vector<std::optional<Support>> supports(growth.contacts.size());
  for (std::size_t layer = 0; layer < slices.layers.size(); ++layer) {
    for (const detail::PrintedSoFar& state : growth.layers[layer])
      if (state.contact && !supports[*state.contact])
        supports[*state.contact] = support_of(slices.layers.front(), growth.contacts[*state.contact]);
    append_shares(slices.layers[layer], slices.layer_mm, growth.layers[layer], supports, found);
  }
  return detail::reported(std::move(found), rules, "print.stands", slices.layer_mm);
}

}  // namespace aplomb
