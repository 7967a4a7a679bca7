#include "aplomb/gcode/detail/bead_hull.h"

#include <array>
#include <cmath>
#include <numbers>

#include "aplomb/balance/detail/convex_hull_2d.h"

namespace aplomb::detail {
namespace {

constexpr std::size_t disc_corners = 32, most_points = 1024;
// Of a hull: a circle of 300 mm loses 0.01 mm by it. Without it every bead of a large round foot costs what all cost.
constexpr std::size_t most_corners = most_points / 2;

std::array<Vec2, disc_corners> unit_disc() {
  std::array<Vec2, disc_corners> disc;
  for (std::size_t i = 0; i < disc_corners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / disc_corners;
    disc[i] = {std::cos(angle), std::sin(angle)};
  }
  return disc;
}

/// Leaves a hull inside the given one.
void drop_every_second(std::vector<Vec2>& hull) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < hull.size(); i += 2) hull[kept++] = hull[i];
  hull.resize(kept);
}

}  // namespace

bool BeadHull::holds(Vec2 center_mm, double radius_mm) const {
  if (hull_.size() < 3) return false;
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const Vec2 edge = hull_[(i + 1) % hull_.size()] - hull_[i];
    if (cross(edge, center_mm - hull_[i]) < radius_mm * norm(edge)) return false;
  }
  return true;
}

void BeadHull::add(Vec2 center_mm, double radius_mm) {
  static const std::array<Vec2, disc_corners> disc = unit_disc();
  if (holds(center_mm, radius_mm)) return;
  for (const Vec2& corner : disc) points_.push_back(center_mm + radius_mm * corner);
  if (points_.size() < most_points) return;
  hull_ = convex_hull(std::move(points_));
  while (hull_.size() > most_corners) drop_every_second(hull_);
  points_ = hull_;
}

std::vector<Vec2> BeadHull::corners() const { return convex_hull(points_); }

void BeadHull::clear() {
  points_.clear();
  hull_.clear();
}

}  // namespace aplomb::detail
