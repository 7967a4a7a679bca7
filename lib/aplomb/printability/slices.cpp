#include "aplomb/printability/slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/corner_table.h"

namespace aplomb {
namespace {

constexpr double most_crossings = 50e6, most_layers = 200'000;
constexpr double least_loop_mm2 = 1e-8;

struct Planes {
  double plate_mm, layer_mm;

  double height_mm(std::size_t layer) const { return plate_mm + (static_cast<double>(layer) + 0.5) * layer_mm; }
  /// How many planes a height is on or above.
  std::uint32_t below(double z_mm) const {
    auto count = static_cast<std::uint32_t>(std::max(0.0, std::floor((z_mm - plate_mm) / layer_mm + 0.5)));
    while (count > 0 && height_mm(count - 1) > z_mm) --count;
    while (height_mm(count) <= z_mm) ++count;
    return count;
  }
};

/// Follows the loops of one closed surface.
class Cutter {
 public:
  /// Where the pulse stopped, of no use.
  Cutter(const TriangleMesh& mesh, const Planes& planes, std::size_t layers, const Pulse& pulse)
      : mesh_(mesh), planes_(planes), corners_(mesh, pulse), starts_(layers + 1), seen_(mesh.triangles.size(), 0) {
    if (pulse.stopped()) return;
    for (const Vec3& v : mesh.vertices) levels_.push_back(planes.below(v.z));
    for (const Triangle& t : mesh.triangles)
      for (std::uint32_t k = lowest(t); k < highest(t); ++k) ++starts_[k + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    crossed_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::uint32_t k = lowest(mesh.triangles[t]); k < highest(mesh.triangles[t]); ++k) crossed_[next[k]++] = t;
  }

  /// Appends the loops at a layer.
  void append_loops(std::uint32_t layer, std::optional<std::uint32_t> void_index, std::vector<SliceLoop>& loops) {
    for (std::size_t i = starts_[layer]; i < starts_[layer + 1]; ++i) {
      if (seen_[crossed_[i]] == layer + 1) continue;
      SliceLoop loop{follow(crossed_[i], layer), {}, {}, void_index};
      if (loop.points_mm.size() < 3) continue;
      loop.moments = plane_moments(loop.points_mm);
      if (std::abs(loop.moments.area_mm2) < least_loop_mm2) continue;
      loop.box_mm = bounding_box(loop.points_mm);
      loops.push_back(std::move(loop));
    }
  }

 private:
  std::uint32_t lowest(const Triangle& t) const { return std::min({levels_[t[0]], levels_[t[1]], levels_[t[2]]}); }
  std::uint32_t highest(const Triangle& t) const { return std::max({levels_[t[0]], levels_[t[1]], levels_[t[2]]}); }

  /// A triangle that is crossed has one half-edge that rises through the plane; with the material on the left, the loop
  /// leaves through it.
  detail::Corner rising(std::uint32_t triangle, std::uint32_t layer) const {
    detail::Corner c = 3 * triangle;
    while (!(levels_[corners_.vertex(c)] <= layer && levels_[corners_.head(c)] > layer)) ++c;
    assert(c < 3 * triangle + 3);
    return c;
  }

  Polygon follow(std::uint32_t first, std::uint32_t layer) {
    Polygon points;
    const double z = planes_.height_mm(layer);
    for (std::uint32_t t = first; seen_[t] != layer + 1;) {
      seen_[t] = layer + 1;
      const detail::Corner c = rising(t, layer);
      const Vec3 a = mesh_.vertices[corners_.vertex(c)], b = mesh_.vertices[corners_.head(c)];
      const double share = (z - a.z) / (b.z - a.z);
      const Vec2 point{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
      if (points.empty() || point != points.back()) points.push_back(point);
      t = corners_.twin(c) / 3;
    }
    while (points.size() > 1 && points.back() == points.front()) points.pop_back();
    return points;
  }

  const TriangleMesh& mesh_;
  const Planes planes_;
  detail::CornerTable corners_;
  std::vector<std::uint32_t> levels_;   // by vertex: planes that it is on or above
  std::vector<std::size_t> starts_;     // by layer, into crossed_
  std::vector<std::uint32_t> crossed_;  // triangles, ascending within a layer
  std::vector<std::uint32_t> seen_;     // by triangle: 1 + the last layer whose loops have passed it
};

/// Every hole belongs to the smallest outline round it.
void find_parts(Slice& slice) {
  for (std::uint32_t i = 0; i < slice.loops.size(); ++i)
    if (slice.loops[i].is_outline()) slice.parts.push_back({{i}, slice.loops[i].moments});
  for (std::uint32_t i = 0; i < slice.loops.size(); ++i) {
    if (slice.loops[i].is_outline()) continue;
    const Vec2 point = slice.loops[i].points_mm.front();
    SlicePart* owner = nullptr;
    for (SlicePart& part : slice.parts) {
      const SliceLoop& outline = slice.outline(part);
      const bool is_smaller = !owner || outline.moments.area_mm2 < slice.outline(*owner).moments.area_mm2;
      if (is_smaller && outline.box_mm.holds(point) && encloses(outline.points_mm, point)) owner = &part;
    }
    if (!owner) continue;  // a hole thinner than rounding, on the rim
    owner->loops.push_back(i);
    owner->moments += slice.loops[i].moments;
  }
}

Result<void> check_budget(const PrintedSolid& printed, const Planes& planes) {
  const double layers = std::ceil(printed.solid.box().size().z / planes.layer_mm);
  double crossings = 0;
  const TriangleMesh& mesh = printed.solid.mesh();
  if (layers <= most_layers)
    for (const Triangle& t : mesh.triangles) {
      const auto [low, high] = std::minmax({mesh.vertices[t[0]].z, mesh.vertices[t[1]].z, mesh.vertices[t[2]].z});
      crossings += (high - low) / planes.layer_mm;
    }
  if (layers <= most_layers && crossings <= most_crossings) return {};
  return fail(ErrorCode::over_budget,
              fmt::format("in layers of {} mm the model has {:.0f} layers and {:.0f} crossings; at most {:.0f} and "
                          "{:.0f} are judged: is the model in another unit, or the layer height?",
                          planes.layer_mm, layers, crossings, most_layers, most_crossings));
}

}  // namespace

Polygons Slice::polygons(const SlicePart& part) const {
  Polygons all;
  for (const std::uint32_t loop : part.loops) all.push_back(loops[loop].points_mm);
  return all;
}

Polygons Slice::material() const {
  Polygons all;
  for (const SliceLoop& loop : loops) all.push_back(loop.points_mm);
  return all;
}

Polygons Slice::void_space() const {
  const auto winding = [&](Vec2 point) {
    int sum = 0;
    for (const SliceLoop& loop : loops)
      if (loop.void_index && loop.box_mm.holds(point) && encloses(loop.points_mm, point))
        sum += loop.is_outline() ? -1 : 1;
    return sum;
  };
  Polygons space;
  for (const SliceLoop& loop : loops)
    if (loop.void_index || winding(loop.points_mm.front()) > 0)
      space.emplace_back(loop.points_mm.rbegin(), loop.points_mm.rend());
  return space;
}

PlaneMoments Slice::moments() const {
  PlaneMoments sum;
  for (const SliceLoop& loop : loops) sum += loop.moments;
  return sum;
}

Result<Slices> cut_slices(const PrintedSolid& printed, double layer_mm, const Job& job, double raised_mm) {
  assert(layer_mm > 0);
  const Planes planes{printed.solid.box().min.z + raised_mm, layer_mm};
  if (const Result<void> fits = check_budget(printed, planes); !fits) return tl::unexpected(fits.error());
  const std::size_t layers = planes.below(printed.solid.box().max.z);
  std::vector<Cutter> cutters;
  cutters.reserve(1 + printed.voids.size());
  const Pulse pulse(job, 0, "slice");
  cutters.emplace_back(printed.outer, planes, layers, pulse);
  for (const TriangleMesh& inner : printed.voids) cutters.emplace_back(inner, planes, layers, pulse);
  if (pulse.stopped()) return cancelled();

  Slices slices{planes.plate_mm, layer_mm, std::vector<Slice>(layers)};
  for (std::uint32_t layer = 0; layer < layers; ++layer) {
    if (layer % 16 == 0 && !job.report(static_cast<double>(layer) / static_cast<double>(layers), "slice"))
      return cancelled();
    Slice& slice = slices.layers[layer];
    slice.z_mm = planes.height_mm(layer);
    for (std::uint32_t i = 0; i < cutters.size(); ++i)
      cutters[i].append_loops(layer, i == 0 ? std::nullopt : std::optional(i - 1), slice.loops);
    find_parts(slice);
  }
  return slices;
}

}  // namespace aplomb
