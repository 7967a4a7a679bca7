#include "aplomb/gcode/detail/brim_loops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "aplomb/balance/detail/convex_hull_2d.h"

namespace aplomb::detail {
namespace {

constexpr std::size_t most_loops = 4096, most_joined_corners = 2048;
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

void BrimLoops::end_loop() {
  if (!current_.empty() && loops_.size() < most_loops) {
    std::vector<Vec2> corners = current_.corners();
    const Reach reach_mm = reach_of(corners);
    loops_.push_back({std::move(corners), width_mm_, reach_mm});
  }
  current_.clear();
  width_mm_ = 0;
}

void BrimLoops::finish() {
  end_loop();
  for (std::size_t k = 0; k < direction_count; ++k) {
    needs_[k].clear();
    for (const Loop& loop : loops_)
      needs_[k].push_back(
          {loop.reach_mm[k] - touching_widths * loop.width_mm, static_cast<std::uint32_t>(needs_[k].size())});
    std::ranges::sort(needs_[k], {}, [](const Need& need) { return std::pair(need.reach_mm, need.loop); });
  }
}

void BrimLoops::add(const Stroke& stroke, double width_mm) {
  if (stroke.to_mm.z > lowest_mm_ + same_layer_mm) return;  // a skirt may be many layers high
  lowest_mm_ = std::min(lowest_mm_, stroke.to_mm.z);
  if (stroke.from_mm != end_mm_) end_loop();
  current_.add(stroke, width_mm);
  width_mm_ = std::max(width_mm_, width_mm);
  end_mm_ = stroke.to_mm;
}

/// The loops that touch, and that widen the reach. A loop is touched once its needs are met in all directions, and each
/// need is met once: what was touched only adds to the reach.
std::vector<const BrimLoops::Loop*> BrimLoops::touched(Reach& reach) const {
  std::vector<const Loop*> widening;
  std::vector<std::uint8_t> met(loops_.size());
  std::array<std::size_t, direction_count> next{};
  const auto touch = [&](const Loop& loop) {
    bool is_wider = false;
    for (std::size_t k = 0; k < direction_count; ++k) {
      is_wider = is_wider || loop.reach_mm[k] > reach[k];
      reach[k] = std::max(reach[k], loop.reach_mm[k]);
    }
    if (is_wider) widening.push_back(&loop);
    return is_wider;
  };
  for (bool grew = true; std::exchange(grew, false);)
    for (std::size_t k = 0; k < direction_count; ++k)
      for (std::size_t& i = next[k]; i < loops_.size() && needs_[k][i].reach_mm <= reach[k]; ++i)
        if (const std::uint32_t loop = needs_[k][i].loop; ++met[loop] == direction_count && touch(loops_[loop]))
          grew = true;
  return widening;
}

std::vector<Vec2> BrimLoops::around(std::span<const Vec2> contact_corners_mm) const {
  Reach reach = reach_of(contact_corners_mm);
  std::vector<const Loop*> loops = touched(reach);
  if (loops.empty()) return {};
  std::size_t count = 0;
  for (const Loop* loop : loops) count += loop->hull_mm.size();
  if (count > most_joined_corners)  // only those that reach farthest somewhere
    std::erase_if(loops, [&reach](const Loop* loop) {
      for (std::size_t k = 0; k < direction_count; ++k)
        if (loop->reach_mm[k] == reach[k]) return false;
      return true;
    });
  std::vector<Vec2> corners(contact_corners_mm.begin(), contact_corners_mm.end());
  for (const Loop* loop : loops) corners.insert(corners.end(), loop->hull_mm.begin(), loop->hull_mm.end());
  return convex_hull(std::move(corners));
}

}  // namespace aplomb::detail
