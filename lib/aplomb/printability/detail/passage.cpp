#include "aplomb/printability/detail/passage.h"

#include <algorithm>
#include <cassert>
#include <queue>
#include <unordered_map>
#include <unordered_set>

namespace aplomb::detail {
namespace {

constexpr double fineness = 60;  // lattice steps in the clearance at last

struct Step {
  VoxelIndex index{};
  double clearance_mm = 0;
};
using Way = std::vector<Step>;

std::uint64_t key_of(const VoxelIndex& index) {
  std::uint64_t key = 0;
  for (const std::int32_t i : index) key = key << 21 | (static_cast<std::uint64_t>(i + (1 << 20)) & 0x1FFFFF);
  return key;
}

struct Less {
  bool operator()(const Step& a, const Step& b) const {
    return a.clearance_mm != b.clearance_mm ? a.clearance_mm < b.clearance_mm : a.index > b.index;
  }
};

/// The widest way from `start` to where `is_end` holds, widest points first; `clearance` is 0 where it may not go.
/// Empty when there is none, or when the pulse stopped.
template <class Clearance, class IsEnd>
Way widest_way(const VoxelIndex& start, Clearance&& clearance, IsEnd&& is_end, const Pulse& pulse) {
  std::priority_queue<Step, std::vector<Step>, Less> front;
  std::unordered_map<std::uint64_t, Step> from;  // the point before, with the clearance of this one
  const double first = clearance(start);
  front.push({start, first});
  from[key_of(start)] = {start, first};
  while (!front.empty() && pulse.goes_on(30)) {
    const Step here = front.top();
    front.pop();
    if (is_end(here)) {
      Way way{here};
      while (way.back().index != start) {
        const Step& before = from.at(key_of(way.back().index));
        way.push_back({before.index, from.at(key_of(before.index)).clearance_mm});
      }
      std::ranges::reverse(way);
      return way;
    }
    for (int n = 0; n < 27; ++n) {
      const VoxelIndex next{here.index[0] + n / 9 - 1, here.index[1] + n / 3 % 3 - 1, here.index[2] + n % 3 - 1};
      const auto [entry, is_new] = from.try_emplace(key_of(next), Step{here.index, 0});
      if (!is_new) continue;
      const double there = clearance(next);
      entry->second.clearance_mm = there;
      if (there > 0) front.push({next, there});
    }
  }
  return {};
}

/// On the lattice, inside one basin, from a contact to near its peak.
Way way_to_peak(const ClearanceLattice& lattice, const Basins& basins, const VoxelIndex& from, std::uint32_t basin,
                const Pulse& pulse) {
  const double goal = 0.95 * std::min(basins.peak_mm(basin), lattice.wide_mm());
  double widest = 0;
  const auto clearance = [&](const VoxelIndex& index) {
    const std::uint32_t element = lattice.element(index);
    if (element == ClearanceLattice::none || basins.of(element) != basin) return 0.0;
    return double(lattice.clearance_mm(element));
  };
  Way way = widest_way(
      from, clearance, [&](const Step& step) { return step.clearance_mm >= goal; }, pulse);
  if (!way.empty()) return way;  // a polished peak may lie above every point: then to the widest there is
  const auto widens = [&](const Step& step) { return widest = std::max(widest, step.clearance_mm), false; };
  widest_way(from, clearance, widens, pulse);
  return widest_way(
      from, clearance, [&](const Step& step) { return step.clearance_mm >= widest; }, pulse);
}

std::size_t narrowest(const Way& way) {
  return static_cast<std::size_t>(std::ranges::min_element(way, {}, &Step::clearance_mm) - way.begin());
}

/// The part that may decide: from the first point that is not certainly wide enough to the last, with their neighbours.
Way doubtful_part(const Way& way, double below_mm) {
  const auto is_doubtful = [&](const Step& step) { return step.clearance_mm < below_mm; };
  auto first = std::ranges::find_if(way, is_doubtful);
  auto last = std::find_if(way.rbegin(), way.rend(), is_doubtful).base();
  assert(first != way.end());
  if (first != way.begin()) --first;
  if (last != way.end()) ++last;
  return {first, last};
}

/// The same way on a lattice of half the spacing, free to move by three of its steps.
Way refined(const EmptySpace& space, const VoxelFrame& fine, const Way& way, const Pulse& pulse) {
  std::unordered_set<std::uint64_t> allowed;  // cells of 2^3 fine points
  for (const Step& step : way)
    for (int n = 0; n < 64; ++n)
      allowed.insert(key_of({step.index[0] + n / 16 - 2, step.index[1] + n / 4 % 4 - 2, step.index[2] + n % 4 - 2}));
  const auto twice = [](const VoxelIndex& i) { return VoxelIndex{2 * i[0], 2 * i[1], 2 * i[2]}; };
  const VoxelIndex end = twice(way.back().index);
  std::uint32_t hint = EmptySpace::no_hint;
  const auto clearance = [&](const VoxelIndex& index) {
    if (!allowed.contains(key_of({index[0] >> 1, index[1] >> 1, index[2] >> 1}))) return 0.0;
    const auto here = space.at(fine.position_mm(index), hint);
    hint = here.triangle;
    return here.mm;
  };
  return widest_way(
      twice(way.front().index), clearance, [&](const Step& step) { return step.index == end; }, pulse);
}

Passage passage_of(const Way& way, const VoxelFrame& frame) {
  const double least = way[narrowest(way)].clearance_mm;
  // Along a bore the clearance is the same but for the lattice: its mouth on the side of a counts.
  const auto at =
      std::ranges::find_if(way, [&](const Step& s) { return s.clearance_mm <= 1.01 * least; }) - way.begin();
  const auto reach = static_cast<std::ptrdiff_t>(least / (2 * frame.voxel_mm)) + 1;
  const auto begin = std::max<std::ptrdiff_t>(0, at - reach);
  const auto end = std::min(static_cast<std::ptrdiff_t>(way.size()) - 1, at + reach);
  const auto position = [&](std::ptrdiff_t n) { return frame.position_mm(way[static_cast<std::size_t>(n)].index); };
  const Vec3 along = position(end) - position(begin);
  return {least, position(at), squared_norm(along) > 0 ? normalized(along) : Vec3{0, 0, 1}};
}

bool is_within(const Box3& box, Vec3 point) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(point[axis] >= box.min[axis] && point[axis] <= box.max[axis])) return false;
  return true;
}

}  // namespace

Passage find_passage(const EmptySpace& space, const ClearanceLattice& lattice, const Basins& basins,
                     const Basins::Contact& contact, double enough_mm, const Pulse& pulse) {
  Way way = way_to_peak(lattice, basins, contact.a, contact.basin_a, pulse);
  std::ranges::reverse(way);
  const Way rest = way_to_peak(lattice, basins, contact.b, contact.basin_b, pulse);
  if (pulse.stopped()) return {};
  way.insert(way.end(), rest.begin(), rest.end());
  VoxelFrame frame = lattice.frame();
  for (;;) {
    const double least = way[narrowest(way)].clearance_mm;
    if (least >= enough_mm || frame.voxel_mm <= least / fineness) return passage_of(way, frame);
    const Way doubtful = doubtful_part(way, least + 2.5 * frame.voxel_mm);
    frame.voxel_mm *= 0.5;
    Way finer = refined(space, frame, doubtful, pulse);
    if (pulse.stopped()) return {};
    if (finer.empty()) return passage_of(way, lattice.frame());
    way = std::move(finer);
  }
}

Peak climb(const EmptySpace& space, Vec3 from_mm, double step_mm) {
  auto here = space.at(from_mm, EmptySpace::no_hint);
  Peak peak{from_mm, here.mm};
  for (double step = step_mm; step > step_mm / 100;) {
    Peak best = peak;
    for (int n = 0; n < 27; ++n) {
      const VoxelIndex way{n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1};
      const Vec3 point = peak.at_mm + step * Vec3{double(way[0]), double(way[1]), double(way[2])};
      const auto there = space.at(point, here.triangle);
      if (there.mm > best.clearance_mm) best = {point, there.mm};
    }
    if (!(best.clearance_mm > peak.clearance_mm)) step *= 0.5;
    else if (is_within(space.box(), best.at_mm)) peak = best;
    else return {from_mm, here.mm};
  }
  return peak;
}

}  // namespace aplomb::detail
