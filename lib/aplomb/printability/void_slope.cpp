#include "aplomb/printability/void_slope.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "aplomb/adapters/clipper/polygon_operations.h"
#include "aplomb/mesh/detail/corner_table.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {
namespace {

constexpr double least_patch_mm2 = 1;
constexpr double rounding_mm2 = 1e-6;
constexpr double arc_mm = 0.005;  // how exactly a reach is drawn

Vec2 flat(Vec3 p) { return {p.x, p.y}; }

struct Facet {
  double slope_deg = 0;  // 180: no ceiling
  double area_mm2 = 0;
};

using Facets = std::vector<std::uint32_t>;

/// The surface of one void.
class Ceiling {
 public:
  explicit Ceiling(const TriangleMesh& surface) : surface_(surface), corners_(surface) {
    for (const Triangle& t : surface.triangles) {
      const Vec3 a = surface.vertices[t[0]];
      const Vec3 n = cross(surface.vertices[t[1]] - a, surface.vertices[t[2]] - a);
      const double up = std::atan2(std::hypot(n.x, n.y), -n.z) * 180 / std::numbers::pi;
      facets_.push_back({n.z < 0 ? up : 180, norm(n) / 2});
    }
  }

  double slope_deg(std::uint32_t facet) const { return facets_[facet].slope_deg; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(facets_.size()); }

  /// Facets flatter than the limit, by patches; each in ascending order.
  std::vector<Facets> patches(double limit_deg) const {
    detail::DisjointSets sets(facets_.size());
    const auto is_flat = [&](std::uint32_t t) { return facets_[t].slope_deg < limit_deg; };
    for (detail::Corner c = 0; c < 3 * size(); ++c)
      if (const std::uint32_t other = corners_.twin(c) / 3; is_flat(c / 3) && is_flat(other)) sets.join(c / 3, other);
    std::map<std::uint32_t, Facets> by_root;
    for (std::uint32_t t = 0; t < size(); ++t)
      if (is_flat(t)) by_root[sets.find(t)].push_back(t);
    std::vector<Facets> all;
    all.reserve(by_root.size());
    for (auto& [root, facets] : by_root) all.push_back(std::move(facets));
    return all;
  }

  double area_mm2(const Facets& facets) const {
    double sum = 0;
    for (const std::uint32_t t : facets) sum += facets_[t].area_mm2;
    return sum;
  }

  /// Whether every point of the patch, seen from above, is within reach_mm of where it rests.
  Result<bool> is_held(const Facets& patch, double reach_mm) const {
    const Plan plan = plan_of(patch);
    if (plan.rests.empty()) return false;
    const Result<Polygons> near = adapters::around(plan.rests, reach_mm, arc_mm);
    if (!near) return tl::unexpected(near.error());
    const Result<Polygons> far = adapters::difference(plan.region, *near);
    if (!far) return tl::unexpected(far.error());
    return aplomb::area_mm2(*far) <= rounding_mm2;
  }

  /// The slope that least_patch_mm2 of the facets is flatter than. \pre They have that area.
  Place flattest(Facets facets) const {
    std::ranges::stable_sort(facets, {}, [&](std::uint32_t t) { return facets_[t].slope_deg; });
    Place place;
    double area = 0;
    bool is_reached = false;
    for (const std::uint32_t t : facets) {
      area += facets_[t].area_mm2;
      const Triangle& corners = surface_.triangles[t];
      for (const std::uint32_t v : corners) place.box_mm.add(surface_.vertices[v]);
      if (area < least_patch_mm2 || is_reached) continue;
      is_reached = true;
      place.measured = facets_[t].slope_deg;
      place.at_mm = (surface_.vertices[corners[0]] + surface_.vertices[corners[1]] + surface_.vertices[corners[2]]) / 3;
    }
    return place;
  }

 private:
  struct Plan {
    Polygons region;
    std::vector<adapters::Line> rests;
  };

  /// The patch seen from above, by its rim, and the parts of it where it rests.
  Plan plan_of(const Facets& patch) const {
    std::multimap<std::uint32_t, detail::Corner> rim;  // by the vertex that a half-edge of the patch leaves
    for (const std::uint32_t t : patch)
      for (detail::Corner c = 3 * t; c < 3 * t + 3; ++c)
        if (!std::ranges::binary_search(patch, corners_.twin(c) / 3)) rim.emplace(corners_.vertex(c), c);
    Plan plan;
    while (!rim.empty()) {
      Polygon& loop = plan.region.emplace_back();
      bool rested = false;
      for (auto edge = rim.begin(); edge != rim.end();) {
        const detail::Corner c = edge->second;
        rim.erase(edge);
        const bool rests = rests_at(c);
        loop.push_back(flat(at(corners_.vertex(c))));
        if (rests && !rested) plan.rests.push_back({loop.back()});
        if (rests) plan.rests.back().push_back(flat(at(corners_.head(c))));
        rested = rests;
        edge = rim.find(corners_.head(c));
      }
      std::ranges::reverse(loop);  // the patch faces down
    }
    return plan;
  }

  /// Whether the surface beyond the half-edge bends down into the void, so that there is material under the edge.
  bool rests_at(detail::Corner c) const {
    const Triangle& facet = surface_.triangles[c / 3];
    const Vec3 a = at(facet[0]), normal = cross(at(facet[1]) - a, at(facet[2]) - a);
    const std::uint32_t beyond = corners_.vertex(detail::CornerTable::previous(corners_.twin(c)));
    return dot(normal, at(beyond) - at(corners_.vertex(c))) > 0;
  }

  Vec3 at(std::uint32_t vertex) const { return surface_.vertices[vertex]; }

  const TriangleMesh& surface_;
  detail::CornerTable corners_;
  std::vector<Facet> facets_;
};

/// Appends what is too flat and no bridge; gives what is neither too flat nor part of a patch left out.
Result<Facets> append_flat_patches(const Ceiling& ceiling, double limit_deg, std::optional<double> span_mm,
                                   std::vector<Place>& found) {
  std::vector<bool> left_out(ceiling.size(), false);
  for (const Facets& patch : ceiling.patches(limit_deg)) {
    for (const std::uint32_t t : patch) left_out[t] = true;
    if (ceiling.area_mm2(patch) < least_patch_mm2) continue;
    const Result<bool> held = span_mm ? ceiling.is_held(patch, *span_mm / 2) : false;
    if (!held) return tl::unexpected(held.error());
    if (!*held) found.push_back(ceiling.flattest(patch));
  }
  Facets steep;
  for (std::uint32_t t = 0; t < ceiling.size(); ++t)
    if (!left_out[t] && ceiling.slope_deg(t) < 180) steep.push_back(t);
  return steep;
}

}  // namespace

Result<std::vector<Place>> measure_void_slope(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                              const Job& job) {
  std::vector<Place> found;
  const std::optional<double> limit = detail::mildest_limit(rules, "void.slope");
  if (!limit) return found;
  const std::optional<double> span_mm = detail::mildest_limit(rules, "void.bridge");
  for (std::size_t i = 0; i < printed.voids.size(); ++i) {
    if (!job.report(static_cast<double>(i) / static_cast<double>(printed.voids.size()), "void slopes"))
      return cancelled();
    const Ceiling ceiling(printed.voids[i]);
    const Result<Facets> steep = append_flat_patches(ceiling, *limit, span_mm, found);
    if (!steep) return tl::unexpected(steep.error());
    if (ceiling.area_mm2(*steep) >= least_patch_mm2) found.push_back(ceiling.flattest(*steep));
  }
  return detail::reported(std::move(found), rules, "void.slope", slices.layer_mm);
}

}  // namespace aplomb
