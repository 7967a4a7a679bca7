#include "aplomb/gcode/detail/brim_loops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "aplomb/balance/detail/convex_hull_2d.h"

namespace aplomb::detail {
namespace {

constexpr std::size_t most_loops = 4096;
constexpr double same_layer_mm = 0.01,
                 touching_widths = 2.5;  // corners, and a gap to break it off; skirts keep 2 mm or more

}  // namespace

BrimLoops::Reach BrimLoops::reach_of(std::span<const Vec2> corners) {
  Reach reach;
  reach.fill(-1e300);
  for (std::size_t k = 0; k < direction_count; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / direction_count;
    const Vec2 direction{std::cos(angle), std::sin(angle)};
    for (const Vec2& corner : corners) reach[k] = std::max(reach[k], dot(direction, corner));
  }
  return reach;
}

/// How far one sticks out of the other at most.
double BrimLoops::beyond(const Reach& outer, const Reach& inner) {
  double most = -1e300;
  for (std::size_t k = 0; k < direction_count; ++k) most = std::max(most, outer[k] - inner[k]);
  return most;
}

void BrimLoops::finish() {
  if (!current_.empty() && loops_.size() < most_loops) {
    std::vector<Vec2> corners = current_.corners();
    const Reach reach_mm = reach_of(corners);
    loops_.push_back({std::move(corners), width_mm_, reach_mm});
  }
  current_.clear();
  width_mm_ = 0;
}

void BrimLoops::add(Vec3 from_mm, Vec3 to_mm, double width_mm) {
  if (to_mm.z > lowest_mm_ + same_layer_mm) return;  // a skirt may be many layers high
  lowest_mm_ = std::min(lowest_mm_, to_mm.z);
  if (from_mm != end_mm_) finish();
  for (const Vec3& end : {from_mm, to_mm}) current_.add({end.x, end.y}, width_mm / 2);
  width_mm_ = std::max(width_mm_, width_mm);
  end_mm_ = to_mm;
}

std::vector<Vec2> BrimLoops::around(std::span<const Vec2> contact_corners_mm) const {
  std::vector<const Loop*> waiting;
  for (const Loop& loop : loops_) waiting.push_back(&loop);
  Reach reach = reach_of(contact_corners_mm);
  std::vector<Vec2> corners(contact_corners_mm.begin(), contact_corners_mm.end());
  bool found = false;
  for (bool grew = true; std::exchange(grew, false);)
    std::erase_if(waiting, [&](const Loop* loop) {
      const double out_mm = beyond(loop->reach_mm, reach);
      if (out_mm > touching_widths * loop->width_mm) return false;
      if (out_mm > 0) {
        for (std::size_t k = 0; k < direction_count; ++k) reach[k] = std::max(reach[k], loop->reach_mm[k]);
        corners.insert(corners.end(), loop->hull_mm.begin(), loop->hull_mm.end());
        grew = found = true;
      }
      return true;
    });
  return found ? convex_hull(std::move(corners)) : std::vector<Vec2>{};
}

}  // namespace aplomb::detail
