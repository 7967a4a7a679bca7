#include "aplomb/holes/hole.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace aplomb {
namespace {

constexpr int sides = 24;

/// Two directions across another one.
std::array<Vec3, 2> across(Vec3 along) {
  const Vec3 other = std::abs(along.z) < 0.7 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = normalized(cross(other, along));
  return {u, cross(along, u)};
}

}  // namespace

std::optional<HoleDemand> hole_demand(const Rules& rules) {
  const auto holes = rules.limits("void.holes");
  if (!holes || !(rules.number("void.hole_mm") > 0)) return std::nullopt;
  HoleDemand demand;
  demand.ball_mm = rules.number("void.hole_mm");
  demand.holes = static_cast<int>(std::ceil(rules.number("void.holes")));
  demand.drains = rules.process() == Process::sla;
  demand.wall_mm = rules.number("wall.void_outer");
  if (rules.limits("void.hole_place")) demand.place_mm = rules.number("void.hole_place");
  if (rules.limits("void.cup_mm")) demand.cup_mm = rules.number("void.cup_mm");
  return demand;
}

TriangleMesh prism_of(const Hole& hole, double from_mm, double clearance_mm) {
  assert(clearance_mm < 0.5 * hole.bore_mm && from_mm < hole.end_mm);
  const auto [u, v] = across(hole.outward);
  const double radius = (0.5 * hole.bore_mm - clearance_mm) / std::cos(std::numbers::pi / sides);
  TriangleMesh prism;
  for (const double along : {from_mm, hole.end_mm}) {
    for (int k = 0; k < sides; ++k) {
      const double angle = hole.turn_rad + 2 * std::numbers::pi * k / sides;
      prism.vertices.push_back(hole.at(along) + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t next = (k + 1) % sides;
    prism.triangles.push_back({k, next, sides + next});
    prism.triangles.push_back({k, sides + next, sides + k});
    if (k == 0 || next == 0) continue;
    prism.triangles.push_back({0, next, k});
    prism.triangles.push_back({sides, sides + k, sides + next});
  }
  return rounded_to_float(std::move(prism));
}

}  // namespace aplomb
