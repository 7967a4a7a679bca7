#include "aplomb/mesh/detail/triangle_tree.h"

#include <algorithm>
#include <cassert>

namespace aplomb::detail {

FloatBox box_of(const TriangleMesh& mesh, const Triangle& t) {
  FloatBox box{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<float>(mesh.vertices[t[0]][axis]), b = static_cast<float>(mesh.vertices[t[1]][axis]),
               c = static_cast<float>(mesh.vertices[t[2]][axis]);
    box.min[axis] = std::min({a, b, c});
    box.max[axis] = std::max({a, b, c});
  }
  return box;
}

FloatBox united(const FloatBox& a, const FloatBox& b) {
  FloatBox box{};
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(a.min[axis], b.min[axis]);
    box.max[axis] = std::max(a.max[axis], b.max[axis]);
  }
  return box;
}

namespace {

/// The ten low bits of x, two zero bits after each.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000FF;
  x = (x | x << 8) & 0x0300F00F;
  x = (x | x << 4) & 0x030C30C3;
  return (x | x << 2) & 0x09249249;
}

constexpr std::uint32_t boxes_a_step = 64;  // about a microsecond

struct Keyed {
  std::uint32_t key, item;
};

std::vector<FloatBox> boxes_of(const TriangleMesh& mesh) {
  std::vector<FloatBox> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) boxes[t] = box_of(mesh, mesh.triangles[t]);
  return boxes;
}

/// Stable, by three passes of ten bits.
void radix_sort(std::vector<Keyed>& items, const Pulse& pulse) {
  std::vector<Keyed> sorted(items.size());
  for (int shift = 0; shift < 30; shift += 10) {
    std::array<std::size_t, 1025> starts{};
    for (const Keyed& item : items) ++starts[(item.key >> shift & 1023) + 1];
    for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
    std::uint32_t count = 0;
    for (const Keyed& item : items) {
      if (++count % boxes_a_step == 0 && !pulse.goes_on()) return;
      sorted[starts[item.key >> shift & 1023]++] = item;
    }
    items.swap(sorted);
  }
}

}  // namespace

BoxTree::BoxTree(const std::vector<FloatBox>& boxes, const Pulse& pulse) {
  assert(!boxes.empty());
  FloatBox all = boxes[0];
  for (const FloatBox& box : boxes) all = united(all, box);
  std::array<double, 3> scale{};
  for (int axis = 0; axis < 3; ++axis) {
    const double size = double{all.max[axis]} - all.min[axis];
    scale[axis] = size > 0 ? 1023.0 / size : 0;
  }
  std::vector<Keyed> items(boxes.size());
  for (std::uint32_t t = 0; t < items.size(); ++t) {
    if (t % boxes_a_step == 0 && !pulse.goes_on()) return;
    std::uint32_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = 0.5 * (double{boxes[t].min[axis]} + boxes[t].max[axis]);
      key |= spread(static_cast<std::uint32_t>((middle - all.min[axis]) * scale[axis])) << axis;
    }
    items[t] = {key, t};
  }
  radix_sort(items, pulse);
  order_.resize(items.size());
  boxes_.resize(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i % boxes_a_step == 0 && !pulse.goes_on()) return;
    order_[i] = items[i].item;
    boxes_[i] = boxes[items[i].item];
  }
  const auto merged = [](const std::vector<FloatBox>& below, std::size_t arity) {
    std::vector<FloatBox> level((below.size() + arity - 1) / arity);
    for (std::size_t i = 0; i < below.size(); ++i)
      level[i / arity] = i % arity == 0 ? below[i] : united(level[i / arity], below[i]);
    return level;
  };
  levels_.push_back(merged(boxes_, leaf_size));
  while (levels_.back().size() > 1) levels_.push_back(merged(levels_.back(), 2));
}

TriangleTree::TriangleTree(const TriangleMesh& mesh, const Pulse& pulse) : BoxTree(boxes_of(mesh), pulse) {}

}  // namespace aplomb::detail
