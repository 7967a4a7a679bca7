#include "aplomb/core/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace aplomb {
namespace {

/// Cohen and Sutherland's: on which outer sides of the box a point lies.
unsigned outcode(const Box2& box, Vec2 p) {
  return unsigned{p.x < box.min.x} | unsigned{p.x > box.max.x} << 1 | unsigned{p.y < box.min.y} << 2 |
         unsigned{p.y > box.max.y} << 3;
}

double squared_distance_mm2(Vec2 point, const Segment& segment) {
  const Vec2 along = segment.to - segment.from, to_point = point - segment.from;
  const double squared = dot(along, along);
  const double share = squared > 0 ? std::clamp(dot(to_point, along) / squared, 0.0, 1.0) : 0;
  const Vec2 off = to_point - share * along;
  return dot(off, off);
}

/// Of the triangle between the origin and an edge, negative where that runs clockwise.
PlaneMoments triangle_moments(Vec2 a, Vec2 b) {
  const double c = cross(a, b);
  return {c / 2, (c / 6) * (a + b), c / 12 * (a.x * a.x + a.x * b.x + b.x * b.x),
          c / 24 * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y),
          c / 12 * (a.y * a.y + a.y * b.y + b.y * b.y)};
}

/// About the origin, of what was measured about another point.
PlaneMoments moved(const PlaneMoments& about, Vec2 o) {
  const auto& [area, first, xx, xy, yy] = about;
  return {area, first + area * o, xx + 2 * o.x * first.x + area * o.x * o.x,
          xy + o.x * first.y + o.y * first.x + area * o.x * o.y, yy + 2 * o.y * first.y + area * o.y * o.y};
}

/// Of the part of a polygon in a half-plane whose border crosses it.
PlaneMoments crossed_moments(const Polygon& polygon, const HalfPlane& half) {
  const Vec2 front = polygon.front();
  const Vec2 origin = front - (half(front) / dot(half.gradient, half.gradient)) * half.gradient;  // on the border
  PlaneMoments sum;
  Vec2 a = polygon.back();
  double at_a = half(a);
  for (const Vec2& b : polygon) {
    const double at_b = half(b);
    if (at_a > 0 || at_b > 0) {
      const Vec2 crossing = a + std::clamp(at_a / (at_a - at_b), 0.0, 1.0) * (b - a);
      sum += triangle_moments((at_a > 0 ? a : crossing) - origin, (at_b > 0 ? b : crossing) - origin);
    }
    a = b;
    at_a = at_b;
  }
  return moved(sum, origin);
}

}  // namespace

PlaneMoments PlaneMoments::about_centroid() const {
  const Vec2 c = centroid_mm();
  return {area_mm2, {}, xx_mm4 - area_mm2 * c.x * c.x, xy_mm4 - area_mm2 * c.x * c.y, yy_mm4 - area_mm2 * c.y * c.y};
}

PlaneMoments operator+(const PlaneMoments& a, const PlaneMoments& b) {
  return {a.area_mm2 + b.area_mm2, a.first_mm3 + b.first_mm3, a.xx_mm4 + b.xx_mm4, a.xy_mm4 + b.xy_mm4,
          a.yy_mm4 + b.yy_mm4};
}

PlaneMoments plane_moments(const Polygon& polygon) {
  PlaneMoments sum;
  if (polygon.empty()) return sum;
  const Vec2 origin = polygon.front();  // so that a polygon far from the origin loses no digits of its area
  Vec2 a = polygon.back() - origin;
  for (const Vec2& point : polygon) {
    const Vec2 b = point - origin;
    sum += triangle_moments(a, b);
    a = b;
  }
  return moved(sum, origin);
}

PlaneMoments plane_moments(const Polygons& polygons, const HalfPlane& half) {
  PlaneMoments sum;
  for (const Polygon& polygon : polygons) {
    const auto within = std::count_if(polygon.begin(), polygon.end(), [&half](Vec2 q) { return half(q) > 0; });
    if (within == std::ssize(polygon)) sum += plane_moments(polygon);
    else if (within > 0) sum += crossed_moments(polygon, half);
  }
  return sum;
}

Polygon clipped(const Box2& box, const HalfPlane& half) {
  const Polygon corners{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
  Polygon kept;
  Vec2 a = corners.back();
  for (const Vec2& b : corners) {
    const double at_a = half(a), at_b = half(b);
    if ((at_a > 0) != (at_b > 0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
    if (at_b > 0) kept.push_back(b);
    a = b;
  }
  return kept;
}

double area_mm2(const Polygon& polygon) {
  if (polygon.empty()) return 0;
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return twice / 2;
}

double area_mm2(const Polygons& polygons) {
  double sum = 0;
  for (const Polygon& polygon : polygons) sum += area_mm2(polygon);
  return sum;
}

Box2 bounding_box(const Polygon& polygon) {
  Box2 box;
  for (const Vec2& point : polygon) box.add(point);
  return box;
}

Box2 bounding_box(const Polygons& polygons) {
  Box2 box;
  for (const Polygon& polygon : polygons)
    for (const Vec2& point : polygon) box.add(point);
  return box;
}

Polygons thinned_outside(const Polygons& polygons, const Box2& box) {
  Polygons kept;
  for (const Polygon& loop : polygons) {
    Polygon thin;
    unsigned side = 0;        // outer sides that the run has in common; none within the box
    bool has_middle = false;  // whether the last corner is one that the run may lose again
    for (const Vec2& p : loop) {
      const unsigned code = outcode(box, p), common = side & code;
      if (common && has_middle) thin.back() = p;
      else thin.push_back(p);
      has_middle = common != 0;
      side = common ? common : code;
    }
    if (thin.size() > 2) kept.push_back(std::move(thin));
  }
  return kept;
}

double distance_mm(Vec2 point, const Segment& segment) { return std::sqrt(squared_distance_mm2(point, segment)); }

double distance_mm(Vec2 point, const std::vector<Segment>& segments) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments) least = std::min(least, squared_distance_mm2(point, segment));
  return std::sqrt(least);
}

bool encloses(const Polygon& polygon, Vec2 p) {
  if (polygon.empty()) return false;
  bool inside = false;
  Vec2 a = polygon.back();
  for (const Vec2& b : polygon) {
    if ((a.y > p.y) != (b.y > p.y) && (cross(b - a, p - a) > 0) == (b.y > a.y)) inside = !inside;
    a = b;
  }
  return inside;
}

std::vector<Polygons> pieces(const Polygons& polygons) {
  std::vector<Polygons> found;
  std::vector<double> areas;
  for (const Polygon& polygon : polygons)
    if (const double area = area_mm2(polygon); area > 0) {
      found.push_back({polygon});
      areas.push_back(area);
    }
  for (const Polygon& polygon : polygons) {
    if (!(area_mm2(polygon) < 0)) continue;
    std::size_t owner = found.size();
    for (std::size_t i = 0; i < found.size(); ++i)
      if ((owner == found.size() || areas[i] < areas[owner]) && encloses(found[i].front(), polygon.front())) owner = i;
    if (owner < found.size()) found[owner].push_back(polygon);
  }
  return found;
}

}  // namespace aplomb
