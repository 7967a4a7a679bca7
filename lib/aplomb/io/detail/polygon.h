#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "aplomb/io/detail/read_context.h"

namespace aplomb::detail {

/// Cuts polygons into triangles over their own corners: n corners give n - 2 triangles, in the polygon's winding.
///
/// Strictly convex ones become a fan; others (concave, or with corners on a straight edge) are cut by clipping ears in
/// the plane they face most, after Meisters 1975. A polygon that crosses itself is cut too, somehow.
/// \par Cost  Linear for convex polygons, else at most quadratic in the corners; the sum over a file is limited.
class PolygonCutter {
 public:
  PolygonCutter(GrowingMesh& mesh, const ReadContext& context) : mesh_(mesh), context_(context) {}

  /// \pre Corners are in range; at least three.
  Result<void> add(std::span<const std::uint32_t> corners);

 private:
  struct Point {
    double x, y;
  };
  static double turn(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

  void project(std::span<const std::uint32_t> corners);
  bool strictly_convex() const;
  Result<void> clip_ears(std::span<const std::uint32_t> corners);
  bool is_ear(std::size_t before, std::size_t at, std::size_t after) const;
  std::size_t find_ear(std::size_t start);
  /// False when it is told to stop, or there were too many steps.
  bool spend(std::uint64_t steps);

  GrowingMesh& mesh_;
  const ReadContext& context_;
  std::vector<Point> points_;                   // of the polygon at hand, counter-clockwise
  std::vector<std::uint32_t> next_, previous_;  // the ring of corners still there
  std::size_t left_ = 0;
  std::uint64_t steps_ = 0, next_report_ = 0;
  bool is_cancelled_ = false;
};

}  // namespace aplomb::detail
