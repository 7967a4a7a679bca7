#include "aplomb/balance/detail/enclosing_circle.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace aplomb::detail {
namespace {

/// How far the circle would have to reach from `center` to hold the other; a point is a circle of radius 0.
double reach_mm(Vec2 center, const Circle& held) { return norm(held.center_mm - center) + held.radius_mm; }

/// The smallest circle around two, one of them perhaps inside the other.
Circle around(const Circle& a, const Circle& b) {
  const double apart = norm(b.center_mm - a.center_mm);
  if (apart + b.radius_mm <= a.radius_mm) return a;
  if (apart + a.radius_mm <= b.radius_mm) return b;
  const double radius = (apart + a.radius_mm + b.radius_mm) / 2;
  return {a.center_mm + ((radius - a.radius_mm) / apart) * (b.center_mm - a.center_mm), radius};
}

/// The circles that go through both points and touch the disc, holding it. With the disc's centre as origin |o| = R - r
/// and |o - p| = |o - q| = R, so o = u + R v is linear in R, and R solves a quadratic. At most two.
std::vector<Circle> through(const Circle& disc, Vec2 point_a, Vec2 point_b) {
  const Vec2 p = point_a - disc.center_mm, q = point_b - disc.center_mm;
  const double determinant = cross(p, q), r = disc.radius_mm;
  if (determinant == 0) return {};                      // in line: two of the three suffice
  const auto solve = [&](double for_p, double for_q) {  // o . p = for_p, o . q = for_q
    return (1 / determinant) * Vec2{for_p * q.y - for_q * p.y, for_q * p.x - for_p * q.x};
  };
  const Vec2 u = solve((dot(p, p) + r * r) / 2, (dot(q, q) + r * r) / 2), v = solve(-r, -r);
  const double a = dot(v, v) - 1, half_b = dot(u, v) + r, c = dot(u, u) - r * r;  // |u + R v|^2 = (R - r)^2
  const double discriminant = half_b * half_b - a * c;
  if (discriminant < 0) return {};
  const double stable = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
  std::vector<Circle> circles;
  for (const double radius : {stable / a, c / stable})
    if (std::isfinite(radius) && radius >= r) circles.push_back({disc.center_mm + u + radius * v, radius});
  return circles;
}

struct Enclosure {
  Circle circle;
  std::vector<Circle> basis;  ///< at most three things of which it is the smallest circle
};

/// The smallest circle around a few things, of all that a pair or a triple of them defines. The disc comes first.
std::optional<Enclosure> around_few(const std::vector<Circle>& few) {
  std::optional<Enclosure> best;
  const auto consider = [&](const Circle& circle, const std::vector<Circle>& basis) {
    const auto is_held = [&](const Circle& held) {
      return reach_mm(circle.center_mm, held) <= circle.radius_mm * (1 + 1e-11);
    };
    if ((!best || circle.radius_mm < best->circle.radius_mm) && std::all_of(few.begin(), few.end(), is_held))
      best = {circle, basis};
  };
  for (std::size_t i = 0; i < few.size(); ++i)
    for (std::size_t j = i + 1; j < few.size(); ++j) {
      consider(around(few[i], few[j]), {few[i], few[j]});
      for (std::size_t k = j + 1; k < few.size(); ++k)
        for (const Circle& circle : through(few[i], few[j].center_mm, few[k].center_mm))
          consider(circle, {few[i], few[j], few[k]});
    }
  return best;
}

}  // namespace

Circle enclosing_circle(std::span<const Vec2> points_mm, const Circle& disc) {
  Circle circle = disc;
  const auto farthest = [&]() -> Circle {
    if (points_mm.empty()) return disc;
    return {*std::max_element(points_mm.begin(), points_mm.end(),
                              [&](Vec2 a, Vec2 b) { return norm(a - circle.center_mm) < norm(b - circle.center_mm); }),
            0};
  };
  std::vector<Circle> few{disc};  // the disc, what defines the circle, and what it fails to hold
  while (reach_mm(circle.center_mm, farthest()) > circle.radius_mm * (1 + 1e-11)) {
    few.push_back(farthest());
    const std::optional<Enclosure> grown = around_few(few);
    if (!grown || grown->circle.radius_mm <= circle.radius_mm) break;  // rounding
    circle = grown->circle;
    few = {disc};
    for (const Circle& point : grown->basis)
      if (point.radius_mm == 0) few.push_back(point);
  }
  circle.radius_mm = std::max(reach_mm(circle.center_mm, disc), reach_mm(circle.center_mm, farthest()));
  return circle;
}

}  // namespace aplomb::detail
