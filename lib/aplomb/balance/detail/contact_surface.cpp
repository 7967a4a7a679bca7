#include "aplomb/balance/detail/contact_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aplomb::detail {
namespace {

/// Where the segment enters and leaves the ball, appended.
void add_segment_crossings(std::vector<Vec3>& points, Vec3 from, Vec3 to, const Contact& ball) {
  const Vec3 along = to - from, out = from - ball.center_mm;
  const double a = squared_norm(along), half_b = dot(along, out);
  const double discriminant = half_b * half_b - a * (squared_norm(out) - ball.radius_mm * ball.radius_mm);
  if (a == 0 || discriminant < 0) return;
  for (const double sign : {-1.0, 1.0}) {
    const double s = (-half_b + sign * std::sqrt(discriminant)) / a;
    if (s >= 0 && s <= 1) points.push_back(from + s * along);
  }
}

bool is_inside(const ConvexPiece& piece, Vec3 normal, Vec3 point) {
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3 a = piece[i], b = piece[(i + 1) % piece.size()];
    if (dot(cross(b - a, point - a), normal) < 0) return false;
  }
  return true;
}

/// The points of the rim (the ball's sphere in the piece's plane) that lie in the piece.
void add_rim_points(std::vector<Vec3>& points, const ConvexPiece& piece, const Contact& ball) {
  const Vec3 doubled_area = cross(piece[1] - piece[0], piece[2] - piece[0]);
  if (squared_norm(doubled_area) == 0) return;
  const PlateFrame plane = plate_frame(doubled_area, 0);
  const double distance_mm = dot(plane.up, ball.center_mm - piece[0]);
  const double squared_radius_mm2 = ball.radius_mm * ball.radius_mm - distance_mm * distance_mm;
  if (squared_radius_mm2 <= 0) return;
  const double radius_mm = std::sqrt(squared_radius_mm2);
  const Vec3 center_mm = ball.center_mm - distance_mm * plane.up;
  constexpr int rim_corners = 128;
  for (int k = 0; k < rim_corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / rim_corners;
    const Vec3 point = center_mm + plane.direction({radius_mm * std::cos(angle), radius_mm * std::sin(angle)});
    if (is_inside(piece, plane.up, point)) points.push_back(point);
  }
}

}  // namespace

bool may_touch(const std::array<Vec3, 3>& corners, const Contact& ball) {
  double squared_distance_mm2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    const double outside_mm = std::max({low - ball.center_mm[axis], ball.center_mm[axis] - high, 0.0});
    squared_distance_mm2 += outside_mm * outside_mm;
  }
  return squared_distance_mm2 <= ball.radius_mm * ball.radius_mm * (1 + 1e-12);
}

std::vector<Vec3> extreme_points_in_ball(const ConvexPiece& piece, const Contact& ball) {
  std::vector<Vec3> points;
  for (const Vec3& corner : piece)
    if (norm(corner - ball.center_mm) <= ball.radius_mm) points.push_back(corner);
  if (points.size() == piece.size() || piece.size() < 3) return points;
  for (std::size_t i = 0; i < piece.size(); ++i)
    add_segment_crossings(points, piece[i], piece[(i + 1) % piece.size()], ball);
  add_rim_points(points, piece, ball);
  return points;
}

ConvexPiece part_below(const std::array<Vec3, 3>& corners, const std::array<double, 3>& heights_mm, double height_mm) {
  ConvexPiece piece;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const bool is_low = heights_mm[i] <= height_mm, next_is_low = heights_mm[j] <= height_mm;
    if (is_low) piece.push_back(corners[i]);
    if (is_low == next_is_low) continue;
    const std::size_t low = is_low ? i : j, high = is_low ? j : i;
    piece.push_back(crossing(corners[low], heights_mm[low], corners[high], heights_mm[high], height_mm));
  }
  return piece;
}

}  // namespace aplomb::detail
