#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "aplomb/gcode/detail/bead_hull.h"

namespace aplomb::detail {

/// The loops of skirts and brims on the bed, of which a brim is what touches an object: PrusaSlicer and Cura have one
/// name for both. Constant memory: of each loop the hull is kept, and of no more than a few thousand loops.
class BrimLoops {
 public:
  void add(const Stroke& stroke, double width_mm);
  /// No more will be added.
  void finish();

  std::size_t count() const { return loops_.size(); }
  /// The hull of an object with the loops that lie within two and a half of their widths of it, one after the other;
  /// nothing where none does. \pre finish() was called. \par Cost  O(loops), however they chain: a millisecond or two.
  std::vector<Vec2> around(std::span<const Vec2> contact_corners_mm) const;

 private:
  static constexpr std::size_t direction_count = 64;
  using Reach = std::array<double, direction_count>;  // how far a shape extends in each direction
  struct Loop {
    std::vector<Vec2> hull_mm;
    double width_mm = 0;
    Reach reach_mm;
  };
  /// What a shape must reach, in one direction, to touch the loop.
  struct Need {
    double reach_mm = 0;
    std::uint32_t loop = 0;
  };
  static Reach reach_of(std::span<const Vec2> corners);
  std::vector<const Loop*> touched(Reach& reach) const;
  void end_loop();

  std::vector<Loop> loops_;
  std::array<std::vector<Need>, direction_count> needs_;  // from the least on
  BeadHull current_{128};
  Vec3 end_mm_;
  double width_mm_ = 0;  // widest of the current loop
  double lowest_mm_ = 1e300;
};

}  // namespace aplomb::detail
