#pragma once

#include <array>
#include <span>
#include <vector>

#include "aplomb/gcode/detail/bead_hull.h"

namespace aplomb::detail {

/// The loops of skirts and brims on the bed, of which a brim is what touches an object: PrusaSlicer and Cura have one
/// name for both. Constant memory: of each loop the hull is kept, and of no more than a few thousand loops.
class BrimLoops {
 public:
  void add(Vec3 from_mm, Vec3 to_mm, double width_mm);
  /// No more will be added.
  void finish();

  /// The hull of an object with the loops that lie within two and a half of their widths of it, one after the other;
  /// nothing where none does. \pre finish() was called.
  std::vector<Vec2> around(std::span<const Vec2> contact_corners_mm) const;

 private:
  static constexpr std::size_t direction_count = 64;
  using Reach = std::array<double, direction_count>;  // how far a shape extends in each direction
  struct Loop {
    std::vector<Vec2> hull_mm;
    double width_mm = 0;
    Reach reach_mm;
  };
  static Reach reach_of(std::span<const Vec2> corners);
  static double beyond(const Reach& outer, const Reach& inner);
  std::vector<Loop> loops_;
  BeadHull current_;
  Vec3 end_mm_;
  double width_mm_ = 0;  // widest of the current loop
  double lowest_mm_ = 1e300;
};

}  // namespace aplomb::detail
