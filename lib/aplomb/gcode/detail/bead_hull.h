#pragma once

#include <cstddef>
#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/gcode/detail/machine.h"

namespace aplomb::detail {

/// The convex hull of beads, which may be many: kept in constant memory, and never larger than the beads.
///
/// A round end is a polygon of 32 corners inside it, the outer edge of an arc one that loses at most 0.002 mm, or
/// 0.03 % of its radius. What sticks out of the hull by no more than such a polygon loses is left out. Of a hull of
/// more corners than it may have those count that lie farthest in as many directions: a circle of 300 mm loses 0.003
/// mm.
class BeadHull {
 public:
  /// \param most_corners  a power of two up to 512
  explicit BeadHull(std::size_t most_corners) : most_corners_(most_corners) {}

  void add(const Stroke& stroke, double width_mm);
  /// \return the corners as detail::convex_hull().
  std::vector<Vec2> corners() const;
  bool empty() const { return hull_.empty() && pending_.empty(); }
  void clear();

 private:
  void add_disc(Vec2 center_mm, double radius_mm);
  void add_arc(const Arc& arc, double half_width_mm);
  bool holds(Vec2 center_mm, double radius_mm) const;
  void merge();

  std::size_t most_corners_;
  std::vector<Vec2> hull_;     // of what came before
  std::vector<Vec2> pending_;  // what may lie outside of it
  Vec2 last_mm_;               // the disc that came last: most strokes begin where one ended
  double last_radius_mm_ = -1;
};

}  // namespace aplomb::detail
