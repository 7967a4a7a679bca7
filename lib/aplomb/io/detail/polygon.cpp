#include "aplomb/io/detail/polygon.h"

namespace aplomb::detail {
namespace {

constexpr std::uint64_t kMaxSteps = 500'000'000;  // two or three seconds
constexpr std::uint64_t kStepsAReport = 1 << 20;

}  // namespace

bool PolygonCutter::spend(std::uint64_t steps) {
  steps_ += steps;
  if (steps_ >= next_report_) {
    next_report_ = steps_ + kStepsAReport;
    is_cancelled_ = !context_.proceed(0.5);
  }
  return !is_cancelled_ && steps_ <= kMaxSteps;
}

Result<void> PolygonCutter::add(std::span<const std::uint32_t> corners) {
  if (corners.size() == 3) {
    if (!mesh_.add_triangle({corners[0], corners[1], corners[2]})) return mesh_.failure();
    return {};
  }
  project(corners);
  if (!strictly_convex()) return clip_ears(corners);
  for (std::size_t i = 2; i < corners.size(); ++i)
    if (!mesh_.add_triangle({corners[0], corners[i - 1], corners[i]})) return mesh_.failure();
  return {};
}

void PolygonCutter::project(std::span<const std::uint32_t> corners) {
  // Newell's normal; dropping its largest axis keeps coordinates exact.
  const auto& vertices = mesh_.mesh().vertices;
  const Vec3 origin = vertices[corners[0]];
  Vec3 normal;
  for (std::size_t i = 2; i < corners.size(); ++i)
    normal += cross(vertices[corners[i - 1]] - origin, vertices[corners[i]] - origin);
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  const bool flip = normal[drop] < 0;
  points_.clear();
  for (const std::uint32_t corner : corners) {
    const Vec3 p = vertices[corner];
    points_.push_back(flip ? Point{p[v], p[u]} : Point{p[u], p[v]});
  }
}

bool PolygonCutter::strictly_convex() const {
  const std::size_t n = points_.size();
  for (std::size_t i = 0; i < n; ++i)
    if (!(turn(points_[i], points_[(i + 1) % n], points_[(i + 2) % n]) > 0)) return false;
  // Left turns only, but perhaps more than once around: then some corner lies right of the fan's spokes.
  for (std::size_t i = 2; i < n; ++i)
    if (!(turn(points_[0], points_[i - 1], points_[i]) > 0)) return false;
  return true;
}

bool PolygonCutter::is_ear(std::size_t before, std::size_t at, std::size_t after) const {
  const Point a = points_[before], b = points_[at], c = points_[after];
  if (!(turn(a, b, c) > 0)) return false;
  for (std::size_t i = next_[after]; i != before; i = next_[i]) {
    const Point p = points_[i];
    if (turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0) continue;
    const auto same = [p](Point q) { return p.x == q.x && p.y == q.y; };
    if (!same(a) && !same(b) && !same(c)) return false;  // in the ear, or on its edge
  }
  return true;
}

std::size_t PolygonCutter::find_ear(std::size_t start) {
  std::size_t widest = start;
  double widest_turn = -1;
  std::size_t at = start;
  for (std::size_t i = 0; i < left_; ++i, at = next_[at]) {
    const double area = turn(points_[previous_[at]], points_[at], points_[next_[at]]);
    if (!spend(area > 0 ? left_ : 1)) return start;
    if (is_ear(previous_[at], at, next_[at])) return at;
    if (area > widest_turn) widest = at, widest_turn = area;
  }
  return widest;  // the polygon crosses itself or has no area
}

Result<void> PolygonCutter::clip_ears(std::span<const std::uint32_t> corners) {
  const std::size_t n = corners.size();
  next_.resize(n);
  previous_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    next_[i] = static_cast<std::uint32_t>((i + 1) % n);
    previous_[i] = static_cast<std::uint32_t>((i + n - 1) % n);
  }
  std::size_t at = 0;
  for (left_ = n; left_ >= 3; --left_) {
    at = left_ == 3 ? at : find_ear(at);
    const bool goes_on = spend(1);
    if (is_cancelled_) return cancelled();
    if (!goes_on)
      return fail(ErrorCode::over_budget, context_.name() + ": its concave polygons have too many corners (one has " +
                                              std::to_string(n) + "); triangulate the model first");
    if (!mesh_.add_triangle({corners[previous_[at]], corners[at], corners[next_[at]]})) return mesh_.failure();
    next_[previous_[at]] = next_[at];
    previous_[next_[at]] = previous_[at];
    at = next_[next_[at]];  // not the neighbour, so that the triangles do not all share one corner
  }
  return {};
}

}  // namespace aplomb::detail
