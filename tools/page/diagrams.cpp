#include "diagrams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace aplomb::page {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int directions = 120;
constexpr double most_shown_rad = 45 * degree;

Vec2 com_on_plate(const Standing& standing) { return standing.support.frame.on_plate(standing.stability.com_mm); }

/// The part of a polygon on the inner side of a line.
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, Vec2 from, Vec2 inward) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double at_a = dot(inward, a - from), at_b = dot(inward, b - from);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return kept;
}

/// Points as an SVG path, y upward.
std::string path_of(const std::vector<Vec2>& points) {
  std::string path;
  for (const Vec2 p : points) path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", p.x, -p.y);
  return path + "Z";
}

std::string svg(double left, double top, double width, double height, const std::string& label,
                const std::string& body) {
  return fmt::format("<svg viewBox=\"{:.2f} {:.2f} {:.2f} {:.2f}\" role=\"img\" aria-label=\"{}\">{}</svg>", left, top,
                     width, height, label, body);
}

}  // namespace

std::vector<Vec2> inset(const std::vector<Vec2>& polygon, double distance_mm) {
  std::vector<Vec2> left = polygon;
  for (std::size_t i = 0; i < polygon.size() && !left.empty(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const Vec2 along = (1 / norm(b - a)) * (b - a), inward{-along.y, along.x};
    left = clipped(left, a + distance_mm * inward, inward);
  }
  return left;
}

double tip_towards_rad(const Standing& standing, Vec2 direction) {
  const Vec2 com = com_on_plate(standing);
  double reach = std::numeric_limits<double>::infinity();
  for (const SupportEdge& edge : standing.support.edges())
    if (const double outward = -dot(edge.inward, direction); outward > 1e-12)
      reach = std::min(reach, dot(edge.inward, com - edge.from_mm) / outward);
  return std::atan2(reach, standing.stability.com_height_mm);
}

std::string support_svg(const Standing& standing, double required_tip_rad) {
  const std::vector<Vec2>& polygon = standing.support.corners_mm;
  const Vec2 com = com_on_plate(standing);
  Box3 box;
  for (const Vec2 p : polygon) box.add({p.x, p.y, 0});
  box.add({com.x, com.y, 0});
  const double size = std::max({box.size().x, box.size().y, 1.0}), rim = 0.12 * size, dot_mm = 0.02 * size;
  std::string body = fmt::format("<path class=\"support\" d=\"{}\"/>", path_of(polygon));
  const auto region = inset(polygon, standing.stability.com_height_mm * std::tan(required_tip_rad));
  if (region.size() > 2) body += fmt::format("<path class=\"region\" d=\"{}\"/>", path_of(region));
  const auto& [from, to] = standing.stability.weak_edge_mm;
  const Vec2 a = standing.support.frame.on_plate(from), b = standing.support.frame.on_plate(to);
  body += fmt::format("<path class=\"weak\" d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\"/>", a.x, -a.y, b.x, -b.y);
  body += fmt::format("<circle class=\"com\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>", com.x, -com.y, dot_mm);
  return svg(box.min.x - rim, -box.max.y - rim, box.size().x + 2 * rim, box.size().y + 2 * rim,
             "Support polygon from above with the centre of mass", body);
}

std::string directions_svg(const Standing& standing, double required_tip_rad) {
  const auto radius = [](double tip_rad) { return 100 * std::clamp(tip_rad / most_shown_rad, 0.0, 1.0); };
  std::vector<Vec2> curve;
  for (int n = 0; n < directions; ++n) {
    const double angle = 2 * std::numbers::pi * n / directions;
    const Vec2 way{std::cos(angle), std::sin(angle)};
    curve.push_back(radius(tip_towards_rad(standing, way)) * way);
  }
  std::string body;
  for (const int ring : {15, 30, 45})
    body += fmt::format("<circle class=\"ring\" r=\"{0:.1f}\"/><text x=\"2\" y=\"{1:.1f}\">{2}°</text>",
                        radius(ring * degree), -radius(ring * degree) - 1, ring);
  body += fmt::format("<path class=\"tip\" d=\"{}\"/><circle class=\"asked\" r=\"{:.1f}\"/>", path_of(curve),
                      radius(required_tip_rad));
  return svg(-112, -112, 224, 224, "Tip angle by direction", body);
}

}  // namespace aplomb::page
