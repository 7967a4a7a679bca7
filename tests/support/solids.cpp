#include "support/solids.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace aplomb::test {
namespace {

using Index = std::uint32_t;

double squared_distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const double along = std::clamp(dot(p - a, b - a) / squared_norm(b - a), 0.0, 1.0);
  return squared_norm(p - (a + along * (b - a)));
}

double squared_distance_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = cross(b - a, c - a);
  const Vec3 foot = p - (dot(p - a, n) / squared_norm(n)) * n;
  const auto left_of = [&](Vec3 from, Vec3 to) { return dot(cross(to - from, foot - from), n) >= 0; };
  if (left_of(a, b) && left_of(b, c) && left_of(c, a)) return squared_norm(p - foot);
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

}  // namespace

SolidMesh solid_of(const TriangleMesh& mesh) { return check_solid(mesh).value().solid.value(); }

TriangleMesh star_prism(int points, double tip_radius_mm, double notch_radius_mm, double height_mm) {
  TriangleMesh mesh{{{0, 0, 0}, {0, 0, height_mm}}, {}};
  const auto n = static_cast<Index>(2 * points);
  for (Index i = 0; i < n; ++i) {
    const double angle = std::numbers::pi * i / points, radius = i % 2 == 0 ? tip_radius_mm : notch_radius_mm;
    for (const double z : {0.0, height_mm})
      mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  for (Index i = 0; i < n; ++i) {
    const Index low = 2 + 2 * i, high = low + 1, next_low = 2 + 2 * ((i + 1) % n), next_high = next_low + 1;
    mesh.triangles.insert(
        mesh.triangles.end(),
        {{0, next_low, low}, {1, high, next_high}, {low, next_low, next_high}, {low, next_high, high}});
  }
  return mesh;
}

TriangleMesh lathe(const std::vector<Vec2>& profile, int segments) {
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, profile.front().y});
  for (std::size_t ring = 1; ring + 1 < profile.size(); ++ring)
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments;
      mesh.vertices.push_back({profile[ring].x * std::cos(angle), profile[ring].x * std::sin(angle), profile[ring].y});
    }
  mesh.vertices.push_back({0, 0, profile.back().y});
  const auto n = static_cast<Index>(segments), rings = static_cast<Index>(profile.size() - 2), top = 1 + n * rings;
  for (Index i = 0; i < n; ++i) {
    const Index next = (i + 1) % n;
    mesh.triangles.push_back({0, 1 + next, 1 + i});
    for (Index ring = 0; ring + 1 < rings; ++ring) {
      const Index low = 1 + n * ring, high = low + n;
      mesh.triangles.push_back({low + i, low + next, high + next});
      mesh.triangles.push_back({low + i, high + next, high + i});
    }
    mesh.triangles.push_back({top - n + i, top - n + next, top});
  }
  return mesh;
}

TriangleMesh dumbbell(const std::vector<Lobe>& lobes, double neck_radius_mm, int segments) {
  std::vector<Vec2> profile;
  const int arcs = segments / 2;
  for (std::size_t n = 0; n < lobes.size(); ++n) {
    const double neck_angle = std::asin(neck_radius_mm / lobes[n].radius_mm);
    const double from = n == 0 ? 0 : neck_angle, to = std::numbers::pi - (n + 1 == lobes.size() ? 0 : neck_angle);
    for (int i = 0; i <= arcs; ++i) {
      const double angle = from + (to - from) * i / arcs;
      const bool pole = (n == 0 && i == 0) || (n + 1 == lobes.size() && i == arcs);
      profile.push_back(
          {pole ? 0 : lobes[n].radius_mm * std::sin(angle), lobes[n].height_mm - lobes[n].radius_mm * std::cos(angle)});
    }
  }
  return lathe(profile, segments);
}

double brute_force_distance_mm(const TriangleMesh& mesh, Vec3 point_mm) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles)
    least = std::min(
        least, squared_distance_to_triangle(point_mm, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
  return std::sqrt(least);
}

bool is_inside(const TriangleMesh& mesh, Vec3 point_mm) {
  double half_angles = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - point_mm, b = mesh.vertices[t[1]] - point_mm,
               c = mesh.vertices[t[2]] - point_mm;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    half_angles += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return half_angles > std::numbers::pi;
}

}  // namespace aplomb::test
