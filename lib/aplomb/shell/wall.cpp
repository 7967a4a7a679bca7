#include "aplomb/shell/wall.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "aplomb/adapters/embree/surface_distance.h"

namespace aplomb {
namespace {

using adapters::SurfaceDistance;

struct Sample {
  Vec3 point;
  SurfaceDistance::Closest nearest;
};

/// Of the smallest circle round a triangle.
double squared_enclosing_radius(Vec3 a, Vec3 b, Vec3 c) {
  const double ab = squared_norm(b - a), bc = squared_norm(c - b), ca = squared_norm(a - c);
  const double longest = std::max({ab, bc, ca});
  if (ab + bc + ca <= 2 * longest) return 0.25 * longest;  // right or obtuse
  return ab * bc * ca / (4 * squared_norm(cross(b - a, c - a)));
}

/// Larger triangles are split before the outer triangles near them are looked at, in walls.
constexpr double largest_radius = 1;
/// What rounding may add to the distance of two triangles.
constexpr double rounding = 1e-9;

class WallSearch {
 public:
  WallSearch(const SurfaceDistance& outer, double good_enough_mm) : outer_(outer), good_enough_(good_enough_mm) {}

  /// A lower bound on the triangle's distance; exact to the tolerance where it is below good_enough.
  double least(const Sample& a, const Sample& b, const Sample& c) const {
    const double nearest = std::min({a.nearest.distance_mm, b.nearest.distance_mm, c.nearest.distance_mm});
    const double squared_radius = squared_enclosing_radius(a.point, b.point, c.point);
    const double squared = nearest * nearest - squared_radius;
    const double bound = squared > 0 ? std::sqrt(squared) : 0;
    if (bound >= good_enough_) return bound;
    if (squared_radius <= largest_radius * largest_radius * good_enough_ * good_enough_)
      return (1 - rounding) * outer_.from_triangle(a.point, b.point, c.point, good_enough_ / (1 - 2 * rounding));
    const Sample ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    return std::min({least(a, ab, ca), least(ab, b, bc), least(ca, bc, c), least(ab, bc, ca)});
  }

 private:
  Sample middle(const Sample& a, const Sample& b) const {
    const Vec3 point = 0.5 * (a.point + b.point);
    return {point, outer_.closest(point, a.nearest.triangle)};
  }

  const SurfaceDistance& outer_;
  const double good_enough_;
};

}  // namespace

Result<WallMeasure> measure_wall(const TriangleMesh& inner, const TriangleMesh& outer, double required_mm,
                                 const Job& job) {
  double least = std::numeric_limits<double>::infinity();
  if (inner.triangles.empty() || outer.triangles.empty()) return WallMeasure{least, {}};
  const SurfaceDistance distance(outer);
  std::vector<Sample> samples(inner.vertices.size());
  constexpr std::size_t batch = 1 << 12;  // between two looks at the job
  for (std::size_t begin = 0; begin < samples.size(); begin += batch) {
    if (!job.report(0.5 * double(begin) / double(samples.size()), "measure the wall")) return cancelled();
    const std::size_t end = std::min(begin + batch, samples.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 256), [&](const auto& range) {
      std::uint32_t hint = SurfaceDistance::no_triangle;
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        samples[i] = {inner.vertices[i], distance.closest(inner.vertices[i], hint)};
        hint = samples[i].nearest.triangle;
      }
    });
  }
  for (const Triangle& t : inner.triangles)
    for (const std::uint32_t v : t) least = std::min(least, samples[v].nearest.distance_mm);
  const WallSearch search(distance, std::max(required_mm, (1 - 1e-4) * least));
  std::vector<double> bounds(inner.triangles.size());
  for (std::size_t begin = 0; begin < bounds.size(); begin += batch) {
    if (!job.report(0.5 + 0.5 * double(begin) / double(bounds.size()), "measure the wall")) return cancelled();
    tbb::parallel_for(begin, std::min(begin + batch, bounds.size()), [&](std::size_t i) {
      const Triangle& t = inner.triangles[i];
      bounds[i] = search.least(samples[t[0]], samples[t[1]], samples[t[2]]);
    });
  }
  WallMeasure wall{std::min(least, *std::ranges::min_element(bounds)), {}};
  for (std::uint32_t i = 0; i < bounds.size(); ++i)
    if (bounds[i] < required_mm) wall.thin.push_back(i);
  return wall;
}

}  // namespace aplomb
