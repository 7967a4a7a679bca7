#include "aplomb/printability/void_base.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "aplomb/adapters/clipper/polygon_operations.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {
namespace {

/// The lowest point of a triangle over the region, if any is; nothing for one that faces sideways or down.
Result<std::optional<Vec3>> lowest_over(const std::array<Vec3, 3>& t, const Polygons& region) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  if (!(n.z > 0)) return std::nullopt;
  const Result<Polygons> over =
      adapters::intersection({{{t[0].x, t[0].y}, {t[1].x, t[1].y}, {t[2].x, t[2].y}}}, region);
  if (!over) return tl::unexpected(over.error());
  std::optional<Vec3> lowest;
  for (const Polygon& loop : *over)
    for (const Vec2& q : loop) {
      const double low = std::min({t[0].z, t[1].z, t[2].z}), high = std::max({t[0].z, t[1].z, t[2].z});
      const double z = std::clamp(t[0].z - (n.x * (q.x - t[0].x) + n.y * (q.y - t[0].y)) / n.z, low, high);
      if (!lowest || z < lowest->z) lowest = Vec3{q.x, q.y, z};
    }
  return lowest;
}

/// The lowest point of a void's surface over the region.
Result<std::optional<Vec3>> lowest_over(const TriangleMesh& surface, const Polygons& region) {
  const auto corners_of = [&](std::uint32_t t) {
    const Triangle& corners = surface.triangles[t];
    return std::array{surface.vertices[corners[0]], surface.vertices[corners[1]], surface.vertices[corners[2]]};
  };
  const auto bottom_mm = [&](std::uint32_t t) {
    const std::array<Vec3, 3> corners = corners_of(t);
    return std::min({corners[0].z, corners[1].z, corners[2].z});
  };
  std::vector<std::uint32_t> upward(surface.triangles.size());
  std::iota(upward.begin(), upward.end(), 0U);
  std::ranges::stable_sort(upward, {}, bottom_mm);
  const Box2 box = bounding_box(region);
  std::optional<Vec3> lowest;
  for (const std::uint32_t t : upward) {
    if (lowest && bottom_mm(t) >= lowest->z) break;
    Box2 plan;
    for (const Vec3& corner : corners_of(t)) plan.add({corner.x, corner.y});
    if (!box.meets(plan)) continue;
    Result<std::optional<Vec3>> here = lowest_over(corners_of(t), region);
    if (!here) return here;
    if (*here && (!lowest || (*here)->z < lowest->z)) lowest = *here;
  }
  return lowest;
}

}  // namespace

Result<std::vector<Place>> measure_void_base(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                             const Job& job) {
  std::vector<Place> found;
  if (!detail::mildest_limit(rules, "void.base") || slices.layers.empty()) return found;
  const Polygons contact = slices.layers.front().material();
  for (std::size_t i = 0; i < printed.voids.size(); ++i) {
    if (!job.report(static_cast<double>(i) / static_cast<double>(printed.voids.size()), "void bases"))
      return cancelled();
    const Result<std::optional<Vec3>> lowest = lowest_over(printed.voids[i], contact);
    if (!lowest) return tl::unexpected(lowest.error());
    if (!*lowest) continue;
    Box3 box = bounding_box(printed.voids[i]);
    box.max.z = (*lowest)->z;
    box.min.z = slices.plate_mm;
    found.push_back({(*lowest)->z - slices.plate_mm, **lowest, box});
  }
  return detail::reported(std::move(found), rules, "void.base", 0);
}

}  // namespace aplomb
