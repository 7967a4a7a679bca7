#include "aplomb/balance/detail/convex_hull_2d.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace aplomb::detail {
namespace {

bool is_left(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// Drops what lies inside the octagon of the extreme points: nothing of it can be a corner (Akl and Toussaint
/// 1978).
void drop_inner_points(std::vector<Vec2>& points) {
  constexpr std::array<Vec2, 8> directions{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  std::array<Vec2, 8> extreme;
  extreme.fill(points.front());
  for (const Vec2& p : points)
    for (std::size_t k = 0; k < 8; ++k)
      if (dot(directions[k], p) > dot(directions[k], extreme[k])) extreme[k] = p;
  if (std::all_of(extreme.begin(), extreme.end(), [&](Vec2 e) { return e == extreme[0]; })) return;
  std::array<double, 8> least{};  // to be inside by more than rounding
  const double extent_mm = std::max(norm(extreme[0] - extreme[4]), norm(extreme[2] - extreme[6]));
  for (std::size_t k = 0; k < 8; ++k) least[k] = 1e-12 * extent_mm * norm(extreme[(k + 1) % 8] - extreme[k]);
  std::erase_if(points, [&](Vec2 p) {
    for (std::size_t k = 0; k < 8; ++k)
      if (extreme[k] != extreme[(k + 1) % 8] && !(cross(extreme[(k + 1) % 8] - extreme[k], p - extreme[k]) > least[k]))
        return false;
    return true;
  });
}

/// One half of Andrew's monotone chain: the points come sorted, the chain turns left everywhere.
template <class Iterator>
void append_chain(std::vector<Vec2>& hull, Iterator first, Iterator last) {
  const std::size_t start = hull.size();
  for (; first != last; ++first) {
    while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], *first - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(*first);
  }
  hull.pop_back();  // the other chain starts with it
}

/// What rounding can do to a coordinate here.
double noise(const std::vector<Vec2>& points) {
  double largest = 0;
  for (const Vec2& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return 1e-13 * largest;
}

/// The hull itself, or where its corners are in line to rounding the two ends, or where they coincide one of
/// them.
std::vector<Vec2> without_false_width(std::vector<Vec2> hull) {
  const auto [left, right] = std::minmax_element(hull.begin(), hull.end(), is_left);
  const auto [low, high] = std::minmax_element(hull.begin(), hull.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; });
  const bool is_flat = norm(*right - *left) >= norm(*high - *low);
  const Vec2 a = is_flat ? *left : *low, b = is_flat ? *right : *high;
  const double noise_mm = noise(hull), length_mm = norm(b - a);
  if (length_mm <= noise_mm) return {a};
  const bool is_wide = std::any_of(hull.begin(), hull.end(),
                                   [&](Vec2 p) { return std::abs(cross(b - a, p - a)) > noise_mm * length_mm; });
  return is_wide ? hull : std::vector<Vec2>{a, b};
}

/// Of corners that coincide but for rounding one.
std::vector<Vec2> without_twins(const std::vector<Vec2>& hull) {
  const double noise_mm = noise(hull);
  std::vector<Vec2> corners;
  for (const Vec2& corner : hull)
    if (corners.empty() || norm(corner - corners.back()) > noise_mm) corners.push_back(corner);
  while (corners.size() > 1 && norm(corners.back() - corners.front()) <= noise_mm) corners.pop_back();
  return corners;
}

/// Leaves out corners that stand off the line through their neighbours by no more than rounding: where a wall's
/// diagonal crosses the contact height, say.
std::vector<Vec2> without_false_corners(const std::vector<Vec2>& hull) {
  const double noise_mm = noise(hull);
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 before = corners.empty() ? hull.back() : corners.back(), after = hull[(i + 1) % hull.size()];
    if (cross(hull[i] - before, after - hull[i]) > noise_mm * norm(after - before)) corners.push_back(hull[i]);
  }
  return corners.size() < 3 ? hull : corners;
}

}  // namespace

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  if (points.empty()) return {};
  if (points.size() > 64) drop_inner_points(points);
  std::sort(points.begin(), points.end(), is_left);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() == 1) return points;
  std::vector<Vec2> hull;
  append_chain(hull, points.begin(), points.end());
  append_chain(hull, points.rbegin(), points.rend());
  hull = without_false_width(std::move(hull));
  return hull.size() < 3 ? hull : without_false_corners(without_twins(hull));
}

}  // namespace aplomb::detail
