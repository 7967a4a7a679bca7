#pragma once

#include <vector>

#include "aplomb/core/vec.h"

namespace aplomb::detail {

/// The convex hull of discs, which may be many: kept in constant memory. A disc is a polygon of 32 corners inside it.
class BeadHull {
 public:
  void add(Vec2 center_mm, double radius_mm);
  /// \return the corners as detail::convex_hull().
  std::vector<Vec2> corners() const;
  bool empty() const { return points_.empty(); }
  void clear();

 private:
  bool holds(Vec2 center_mm, double radius_mm) const;

  std::vector<Vec2> points_;
  std::vector<Vec2> hull_;  // of some of them
};

}  // namespace aplomb::detail
