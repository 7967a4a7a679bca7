#include "aplomb/mesh/detail/nearest.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace aplomb::detail {
namespace {

double squared_distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double length = squared_norm(along);
  const double share = length > 0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0;
  return squared_norm(p - a - share * along);
}

double squared_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = cross(b - a, c - a);
  const double area = squared_norm(normal);
  if (area > 0 && dot(cross(b - a, p - a), normal) >= 0 && dot(cross(c - b, p - b), normal) >= 0 &&
      dot(cross(a - c, p - c), normal) >= 0) {
    const double height = dot(p - a, normal);
    return height * height / area;
  }
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

double squared_distance(Vec3 p, const FloatBox& box) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double away = std::max({box.min[axis] - p[axis], p[axis] - box.max[axis], 0.0});
    sum += away * away;
  }
  return sum;
}

}  // namespace

double distance_mm(Vec3 p, Vec3 a, Vec3 b, Vec3 c) { return std::sqrt(squared_distance(p, a, b, c)); }

double distance_mm(Vec3 p, const TriangleMesh& mesh, const TriangleTree& tree, double limit_mm) {
  double best = limit_mm * limit_mm;
  tree.for_each_nearest_first([&](const FloatBox& box) { return squared_distance(p, box); }, best,
                              [&](std::uint32_t t) {
                                const auto [a, b, c] = mesh.triangles[t];
                                best = std::min(
                                    best, squared_distance(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
                              });
  return std::sqrt(best);
}

double largest_distance_mm(const TriangleMesh& mesh, const TriangleMesh& surface) {
  const TriangleTree tree(surface);
  Box3 all = bounding_box(mesh);
  all.add(bounding_box(surface).min);
  all.add(bounding_box(surface).max);
  const double limit = 2 * all.diagonal();
  const auto largest = [](double a, double b) { return std::max(a, b); };
  const auto over = [&](std::size_t count, auto point) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, count, 256), 0.0,
        [&](const tbb::blocked_range<std::size_t>& range, double so_far) {
          for (std::size_t i = range.begin(); i != range.end(); ++i)
            so_far = std::max(so_far, distance_mm(point(i), surface, tree, limit));
          return so_far;
        },
        largest);
  };
  return std::max(over(mesh.vertices.size(), [&](std::size_t v) { return mesh.vertices[v]; }),
                  over(mesh.triangles.size(), [&](std::size_t t) {
                    const auto [a, b, c] = mesh.triangles[t];
                    return (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
                  }));
}

}  // namespace aplomb::detail
