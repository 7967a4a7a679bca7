#include "aplomb/printability/stand_checks.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "aplomb/mesh/detail/topology.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double trapped_error_ratio = 0.05;  // of densities

Vec3 normal_of(const TriangleMesh& mesh, const Triangle& t) {
  return normalized(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]));
}

double area_mm2(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += 0.5 * norm(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]));
  return sum;
}

/// Half the sum of length x turn over the edges, turns outward positive. \pre The surface is wound outward.
double mean_curvature_mm(const TriangleMesh& mesh) {
  double sum = 0;
  detail::EdgeTable(mesh).for_each([&](std::uint32_t low, std::uint32_t high, std::span<const detail::Corner> corners) {
    const std::size_t first = corners[0] / 3, second = corners[1] / 3;
    const Vec3 m = normal_of(mesh, mesh.triangles[first]), n = normal_of(mesh, mesh.triangles[second]);
    const bool is_up = detail::vertex_at(mesh, corners[0]) == low;
    const Vec3 along = mesh.vertices[is_up ? high : low] - mesh.vertices[is_up ? low : high];
    const double length = norm(along);
    sum += 0.5 * length * std::atan2(dot(cross(m, n), along) / length, dot(m, n));
  });
  return sum;
}

std::vector<Place> tip_place(const Standing& standing, double tip_rad) {
  const auto& [from, to] = standing.stability.weak_edge_mm;
  Box3 edge;
  edge.add(from), edge.add(to);
  return {{tip_rad / degree, 0.5 * (from + to), edge}};
}

}  // namespace

Result<StandMeasures> measure_stand(const PrintedSolid& printed, const StandingPose& pose, std::vector<Region> body,
                                    double trapped_g_per_cm3) {
  assert(trapped_g_per_cm3 >= 0);
  const auto empty = measure_standing(printed.solid.mesh(), body, pose);
  if (!empty) return tl::unexpected(empty.error());
  if (trapped_g_per_cm3 > 0)
    for (const TriangleMesh& inner : printed.voids)
      body.push_back({-1 * moments(inner), trapped_g_per_cm3, trapped_error_ratio});
  StandMeasures measures{
      tip_place(*empty, empty->stability.tip_rad), tip_place(*empty, empty->stability.robust_tip_rad), {}};
  if (printed.voids.empty()) return measures;
  const auto full = measure_standing(printed.solid.mesh(), body, pose);
  if (!full) return tl::unexpected(full.error());
  measures.trapped = tip_place(*full, full->stability.tip_rad);
  return measures;
}

std::vector<Place> mass_gained_percent(const PrintedSolid& printed, const Filling& filling) {
  const double f = filling.infill_ratio, s = filling.skin_mm;
  const double whole = f * moments(printed.outer).volume_mm3 + (1 - f) * s * area_mm2(printed.outer);
  double gained = 0;
  for (const TriangleMesh& inner : printed.voids) {
    const TriangleMesh outward = reversed(inner);
    const double skin =
        area_mm2(outward) * s + mean_curvature_mm(outward) * s * s + 4.0 / 3 * std::numbers::pi * s * s * s;
    gained += (1 - f) * skin - f * moments(outward).volume_mm3;
  }
  return {{100 * gained / whole, {}, {}}};
}

}  // namespace aplomb
