#include "aplomb/inserts/pocket.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace aplomb {
namespace {

using std::numbers::pi;

constexpr std::uint32_t segments = 64;
constexpr int steps_of_a_floor = 12;

/// The next boundary between layers.
double whole_layers(double height_mm, double layer_mm) { return std::ceil(height_mm / layer_mm - 1e-9) * layer_mm; }

/// Half a ball, up to its equator.
void add_round_floor(std::vector<Vec2>& profile, double radius) {
  for (int i = 0; i <= steps_of_a_floor; ++i) {
    const double angle = pi / 2 * i / steps_of_a_floor;
    profile.push_back({i == 0 ? 0 : radius * std::sin(angle), radius * (1 - std::cos(angle))});
  }
}

/// Rings a layer high that leave at last what one bridge spans.
void add_rings(std::vector<Vec2>& profile, const PocketRules& rules) {
  const double radius = profile.back().x, last = std::min(radius, rules.bridge_mm / 2);
  const int rings = static_cast<int>(std::ceil((radius - last) / (rules.bridge_mm / 2) - 1e-9));
  for (int ring = 1; ring <= rings; ++ring) {
    const double inner = radius + (last - radius) * ring / rings, height = profile.back().y;
    profile.push_back({inner, height});
    profile.push_back({inner, height + rules.layer_mm});
  }
}

void add_cone(std::vector<Vec2>& profile, const PocketRules& rules) {
  const double radius = profile.back().x, last = std::min(radius, rules.bridge_mm / 2);
  if (last >= radius) return;
  const double rise = (radius - last) * std::tan(rules.slope_deg * pi / 180);
  const double top = profile.back().y + whole_layers(rise, rules.layer_mm);
  profile.push_back({last, top - (whole_layers(rise, rules.layer_mm) - rise)});
  if (top > profile.back().y + 1e-6) profile.push_back({last, top});
}

}  // namespace

Pocket pocket_for(const Insert& insert, int stacked, const PocketRules& rules) {
  assert(stacked >= 1 && rules.layer_mm > 0 && rules.bridge_mm > 0);
  const bool is_ball = insert.shape == Insert::Shape::ball;
  const double lifted = is_ball ? rules.layer_mm / 2 : 0;  // by the steps of a floor of layers
  Pocket pocket{insert, stacked, {}, 0, 0, insert.diameter_mm / 2 + rules.beside_mm, 0};
  pocket.open_mm = whole_layers(stacked * insert.height_mm + lifted + rules.above_mm, rules.layer_mm);
  pocket.inserts_at_mm = stacked * insert.height_mm / 2;
  if (is_ball) add_round_floor(pocket.profile, pocket.radius_mm);
  else pocket.profile = {{0, 0}, {pocket.radius_mm, 0}};
  pocket.profile.push_back({pocket.radius_mm, pocket.open_mm});
  if (is_ball) add_cone(pocket.profile, rules);
  else add_rings(pocket.profile, rules);
  pocket.height_mm = pocket.profile.back().y;
  pocket.profile.push_back({0, pocket.height_mm});
  return pocket;
}

TriangleMesh pocket_mesh(const Pocket& pocket, Vec3 floor_mm) {
  const auto& profile = pocket.profile;
  const double widened = 1 / std::cos(pi / segments);
  const auto rings = static_cast<std::uint32_t>(profile.size() - 2);
  TriangleMesh mesh;
  mesh.vertices.push_back(floor_mm + Vec3{0, 0, profile.front().y});
  for (std::uint32_t ring = 1; ring <= rings; ++ring)
    for (std::uint32_t i = 0; i < segments; ++i) {
      const double angle = 2 * pi * i / segments, radius = widened * profile[ring].x;
      mesh.vertices.push_back(floor_mm + Vec3{radius * std::cos(angle), radius * std::sin(angle), profile[ring].y});
    }
  mesh.vertices.push_back(floor_mm + Vec3{0, 0, profile.back().y});
  const std::uint32_t top = rings * segments + 1;
  const auto at = [](std::uint32_t ring, std::uint32_t i) { return 1 + ring * segments + i % segments; };
  for (std::uint32_t i = 0; i < segments; ++i) {
    mesh.triangles.push_back({0, at(0, i + 1), at(0, i)});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangles.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
      mesh.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
    }
    mesh.triangles.push_back({top, at(rings - 1, i), at(rings - 1, i + 1)});
  }
  return mesh;
}

Moments pocket_moments(const Pocket& pocket, Vec3 floor_mm) {
  // A frustum between polygons of area k r^2: the integrals of k r(z)^2 and of z k r(z)^2, r linear.
  const double k = segments * std::tan(pi / segments);
  double volume = 0, height_moment = 0;
  for (std::size_t i = 0; i + 1 < pocket.profile.size(); ++i) {
    const auto [r, z] = pocket.profile[i];
    const auto [s, w] = pocket.profile[i + 1];
    const double rise = w - z;
    volume += k * rise * (r * r + r * s + s * s) / 3;
    height_moment += k * rise * (z * (r * r + r * s + s * s) / 3 + rise * (r * r + 2 * r * s + 3 * s * s) / 12);
  }
  return {volume, volume * Vec3{floor_mm.x, floor_mm.y, floor_mm.z} + Vec3{0, 0, height_moment}};
}

}  // namespace aplomb
