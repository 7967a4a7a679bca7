#include "aplomb/gcode/detail/bead_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "aplomb/balance/detail/convex_hull_2d.h"

namespace aplomb::detail {
namespace {

constexpr std::size_t direction_count = 512, disc_corners = 32, most_arc_corners = 128;
constexpr double arc_error_mm = 0.002;

/// Evenly around, from x on.
const std::array<Vec2, direction_count>& directions() {
  static const std::array<Vec2, direction_count> all = [] {
    std::array<Vec2, direction_count> units;
    for (std::size_t i = 0; i < units.size(); ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / direction_count;
      units[i] = {std::cos(angle), std::sin(angle)};
    }
    return units;
  }();
  return all;
}

/// How much smaller the circle is that lies in a polygon of so many corners than the one about it, whatever rounding
/// does to them.
double inner_ratio(std::size_t corners) {
  return (1 - 1e-9) * std::cos(std::numbers::pi / static_cast<double>(corners));
}

std::size_t corners_of_circle(double radius_mm) {
  std::size_t corners = disc_corners;
  while (corners < most_arc_corners && radius_mm * (1 - inner_ratio(corners)) > arc_error_mm) corners *= 2;
  return corners;
}

/// Leaves the corners that lie farthest in some of so many directions: a hull inside the given one. Done again, it
/// drops no more of them, as dropping every second would: of a circle drawn in small steps the first half went so.
void keep_farthest(std::vector<Vec2>& hull, std::size_t count) {
  std::vector<Vec2> kept;
  std::size_t at = 0;
  for (std::size_t i = 1; i < hull.size(); ++i)
    if (hull[i].x > hull[at].x) at = i;
  for (std::size_t k = 0; k < direction_count; k += direction_count / count) {
    for (std::size_t step = 0; step < hull.size(); ++step) {
      const std::size_t next = (at + 1) % hull.size();
      if (!(dot(directions()[k], hull[next] - hull[at]) > 0)) break;
      at = next;
    }
    if (kept.empty() || kept.back() != hull[at]) kept.push_back(hull[at]);
  }
  if (kept.size() > 1 && kept.back() == kept.front()) kept.pop_back();
  hull = std::move(kept);
}

}  // namespace

bool BeadHull::holds(Vec2 center_mm, double radius_mm) const {
  if (hull_.size() < 3) return false;
  const double radius2_mm2 = radius_mm * radius_mm;
  Vec2 from = hull_.back();
  for (const Vec2& to : hull_) {
    const Vec2 edge = to - from;
    const double inside = cross(edge, center_mm - from);  // the distance times the edge's length
    if (inside < 0 || inside * inside < radius2_mm2 * dot(edge, edge)) return false;
    from = to;
  }
  return true;
}

void BeadHull::merge() {
  pending_.insert(pending_.end(), hull_.begin(), hull_.end());
  hull_ = convex_hull(std::move(pending_));
  if (hull_.size() > most_corners_) keep_farthest(hull_, most_corners_);
  hull_.shrink_to_fit();
  pending_ = {};
}

void BeadHull::add_disc(Vec2 center_mm, double radius_mm) {
  if (center_mm == last_mm_ && radius_mm <= last_radius_mm_) return;
  last_mm_ = center_mm;
  last_radius_mm_ = radius_mm;
  static const double inner = inner_ratio(disc_corners);
  if (holds(center_mm, inner * radius_mm)) return;
  for (std::size_t i = 0; i < direction_count; i += direction_count / disc_corners)
    pending_.push_back(center_mm + radius_mm * directions()[i]);
  if (pending_.size() >= most_corners_) merge();
}

void BeadHull::add_arc(const Arc& arc, double half_width_mm) {
  const double outer_mm = arc.radius_mm + half_width_mm;
  const std::size_t corners = corners_of_circle(outer_mm);
  if (holds(arc.center_mm, inner_ratio(corners) * outer_mm)) return;
  constexpr double turn = 2 * std::numbers::pi;
  const double first_rad = arc.sweep_rad > 0 ? arc.from_rad : arc.from_rad + arc.sweep_rad;
  for (std::size_t i = 0; i < direction_count; i += direction_count / corners) {
    const double past_rad = turn * static_cast<double>(i) / direction_count - first_rad;
    if (past_rad - turn * std::floor(past_rad / turn) <= std::abs(arc.sweep_rad))
      pending_.push_back(arc.center_mm + outer_mm * directions()[i]);
  }
  if (pending_.size() >= most_corners_) merge();
}

void BeadHull::add(const Stroke& stroke, double width_mm) {
  for (const Vec3& end : {stroke.from_mm, stroke.to_mm}) add_disc({end.x, end.y}, width_mm / 2);
  if (stroke.arc) add_arc(*stroke.arc, width_mm / 2);
}

std::vector<Vec2> BeadHull::corners() const {
  std::vector<Vec2> all = hull_;
  all.insert(all.end(), pending_.begin(), pending_.end());
  return convex_hull(std::move(all));
}

void BeadHull::clear() { *this = BeadHull(most_corners_); }

}  // namespace aplomb::detail
