#include "aplomb/printability/void_slope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "aplomb/mesh/detail/corner_table.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {
namespace {

constexpr double least_patch_mm2 = 1;
constexpr double resolution_mm = 0.005;  // of a reach

Vec2 flat(Vec3 p) { return {p.x, p.y}; }

struct Facet {
  double slope_deg = 0;  // 180: no ceiling
  double area_mm2 = 0;
};

using Facets = std::vector<std::uint32_t>;

/// A triangle seen from above.
struct FlatTriangle {
  std::array<Vec2, 3> corners;

  double longest_mm() const {
    return std::max({norm(corners[1] - corners[0]), norm(corners[2] - corners[1]), norm(corners[0] - corners[2])});
  }
  Vec2 middle() const { return (1.0 / 3) * (corners[0] + corners[1] + corners[2]); }
};

/// Tells of triangle after triangle whether all of it is within reach of some segments, but for resolution_mm.
class Reach {
 public:
  /// \pre There is a segment.
  Reach(std::vector<Segment> segments, double reach_mm) : segments_(std::move(segments)), reach_mm_(reach_mm) {}

  bool holds(const FlatTriangle& triangle) {
    if (is_near(triangle, nearest_)) return true;  // neighbours mostly have one nearest segment
    const Vec2 middle = triangle.middle();
    nearest_ = *std::ranges::min_element(segments_, {}, [&](const Segment& s) { return distance_mm(middle, s); });
    return is_near(triangle, nearest_) || is_near(triangle, segments_);
  }

 private:
  static double farthest_mm(const FlatTriangle& triangle, const auto& from) {
    double most = 0;
    for (const Vec2& corner : triangle.corners) most = std::max(most, distance_mm(corner, from));
    return most;
  }

  /// The distance from one segment is convex.
  bool is_near(const FlatTriangle& triangle, const Segment& segment) const {
    return farthest_mm(triangle, segment) <= reach_mm_;
  }

  /// Distances grow no faster than one walks, and no point is farther from its nearest corner than the longest side /
  /// sqrt 3. Where that does not settle it, the triangle is quartered.
  bool is_near(const FlatTriangle& triangle, std::vector<Segment> segments) const {
    const double far_mm = farthest_mm(triangle, segments), longest_mm = triangle.longest_mm();
    if (far_mm > reach_mm_) return false;
    if (longest_mm < resolution_mm || far_mm + longest_mm / std::numbers::sqrt3 <= reach_mm_) return true;
    const auto& [a, b, c] = triangle.corners;
    std::erase_if(segments, [&, from = a](const Segment& s) { return distance_mm(from, s) > reach_mm_ + longest_mm; });
    const Vec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    return is_near({{a, ab, ca}}, segments) && is_near({{ab, b, bc}}, segments) && is_near({{ca, bc, c}}, segments) &&
           is_near({{ab, bc, ca}}, segments);
  }

  std::vector<Segment> segments_;
  double reach_mm_;
  Segment nearest_ = segments_.front();
};

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
  bool is_held(const Facets& patch, double reach_mm) const {
    std::vector<Segment> rests = rests_of(patch);
    if (rests.empty()) return false;
    Reach reach(std::move(rests), reach_mm);
    return std::ranges::all_of(patch, [&](std::uint32_t t) {
      const Triangle& facet = surface_.triangles[t];
      return reach.holds({{flat(at(facet[0])), flat(at(facet[1])), flat(at(facet[2]))}});
    });
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
  /// The parts of the patch's rim, seen from above, where it rests.
  std::vector<Segment> rests_of(const Facets& patch) const {
    std::vector<Segment> rests;
    for (const std::uint32_t t : patch)
      for (detail::Corner c = 3 * t; c < 3 * t + 3; ++c)
        if (!std::ranges::binary_search(patch, corners_.twin(c) / 3) && rests_at(c))
          rests.push_back({flat(at(corners_.vertex(c))), flat(at(corners_.head(c)))});
    return rests;
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
Facets append_flat_patches(const Ceiling& ceiling, double limit_deg, std::optional<double> span_mm,
                           std::vector<Place>& found) {
  std::vector<bool> left_out(ceiling.size(), false);
  for (const Facets& patch : ceiling.patches(limit_deg)) {
    for (const std::uint32_t t : patch) left_out[t] = true;
    if (ceiling.area_mm2(patch) < least_patch_mm2) continue;
    if (!span_mm || !ceiling.is_held(patch, *span_mm / 2)) found.push_back(ceiling.flattest(patch));
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
    const Facets steep = append_flat_patches(ceiling, *limit, span_mm, found);
    if (ceiling.area_mm2(steep) >= least_patch_mm2) found.push_back(ceiling.flattest(steep));
  }
  return detail::reported(std::move(found), rules, "void.slope", slices.layer_mm);
}

}  // namespace aplomb
