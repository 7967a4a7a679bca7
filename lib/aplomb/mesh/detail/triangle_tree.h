#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "aplomb/core/pulse.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

struct FloatBox {
  std::array<float, 3> min, max;

  bool meets(const FloatBox& b) const {
    return min[0] <= b.max[0] && b.min[0] <= max[0] && min[1] <= b.max[1] && b.min[1] <= max[1] && min[2] <= b.max[2] &&
           b.min[2] <= max[2];
  }
};

/// Of a triangle. \pre Its coordinates are float32 values: the box is then exact.
FloatBox box_of(const TriangleMesh& mesh, const Triangle& t);
FloatBox united(const FloatBox& a, const FloatBox& b);

/// Boxes in a binary tree: leaves of four in Morton order, built bottom-up.
///
/// \pre There is a box.
/// \par Cost  O(n); 8 ms for 100k boxes.
class BoxTree {
 public:
  static constexpr std::uint32_t leaf_size = 4;

  /// Where the pulse stopped, of no use.
  explicit BoxTree(const std::vector<FloatBox>& boxes, const Pulse& pulse = {});

  std::uint32_t leaves() const { return static_cast<std::uint32_t>(levels_[0].size()); }
  /// Level 0 is the leaves', the last one the root's; node i has children 2 i and 2 i + 1 a level below, if they exist.
  std::uint32_t levels() const { return static_cast<std::uint32_t>(levels_.size()); }
  std::uint32_t nodes(std::uint32_t level) const { return static_cast<std::uint32_t>(levels_[level].size()); }
  std::span<const std::uint32_t> items_of(std::uint32_t leaf) const {
    return {order_.data() + std::size_t{leaf} * leaf_size, order_.data() + leaf_end(leaf)};
  }

  /// Calls visit(s, t) once for every pair of items whose boxes meet and of which the one that stands first in the tree
  /// is in the leaf; leaves 0 .. leaves() - 1 together give every pair.
  template <class Visit>
  void pairs_of_leaf(std::uint32_t leaf, Visit&& visit) const {
    const FloatBox box = levels_[0][leaf];
    const auto enter = [&](std::uint32_t level, std::uint32_t index, const FloatBox& node) {
      return ((std::uint64_t{index} + 1) << level) > leaf && box.meets(node);
    };
    descend(enter, [&](std::uint32_t other) {
      for (std::uint32_t i = leaf * leaf_size; i < leaf_end(leaf); ++i)
        for (std::uint32_t j = other == leaf ? i + 1 : other * leaf_size; j < leaf_end(other); ++j)
          if (boxes_[i].meets(boxes_[j])) visit(order_[i], order_[j]);
    });
  }

  /// Calls visit(t) for every item whose box satisfies `meets`, a test that holds for a box when it does for a part of
  /// it.
  template <class Meets, class Visit>
  void for_each(Meets&& meets, Visit&& visit) const {
    walk([&](std::uint32_t, std::uint32_t, const FloatBox& box) { return meets(box); },
         [&](std::uint32_t item, const FloatBox& box) {
           if (meets(box)) visit(item);
         });
  }

  /// Calls enter(level, index, box) of nodes from the root down, and visit(item, box) of what is in the leaves entered.
  template <class Enter, class Visit>
  void walk(Enter&& enter, Visit&& visit) const {
    descend(enter, [&](std::uint32_t leaf) {
      for (std::uint32_t i = leaf * leaf_size; i < leaf_end(leaf); ++i) visit(order_[i], boxes_[i]);
    });
  }

  /// Calls visit(t) for items whose box is nearer than `bound`, which visit lowers; near children first.
  template <class Distance, class Visit>
  void for_each_nearest_first(Distance&& distance, const double& bound, Visit&& visit) const {
    struct Node {
      std::uint32_t level, index;
      double distance;
    };
    std::array<Node, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0, distance(levels_.back()[0])};
    while (depth > 0) {
      const Node node = stack[--depth];
      if (node.distance >= bound) continue;
      if (node.level == 0) {
        for (std::uint32_t i = node.index * leaf_size; i < leaf_end(node.index); ++i)
          if (distance(boxes_[i]) < bound) visit(order_[i]);
        continue;
      }
      const std::vector<FloatBox>& below = levels_[node.level - 1];
      Node near{node.level - 1, 2 * node.index, distance(below[2 * node.index])};
      if (2 * node.index + 1 < below.size()) {
        Node far{node.level - 1, 2 * node.index + 1, distance(below[2 * node.index + 1])};
        if (far.distance < near.distance) std::swap(near, far);
        stack[depth++] = far;
      }
      stack[depth++] = near;
    }
  }

 private:
  std::uint32_t leaf_end(std::uint32_t leaf) const {
    return std::min((leaf + 1) * leaf_size, static_cast<std::uint32_t>(order_.size()));
  }

  template <class Enter, class VisitLeaf>
  void descend(Enter&& enter, VisitLeaf&& visit_leaf) const {
    struct Node {
      std::uint32_t level, index;
    };
    std::array<Node, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
    while (depth > 0) {
      const Node node = stack[--depth];
      if (!enter(node.level, node.index, levels_[node.level][node.index])) continue;
      if (node.level == 0) {
        visit_leaf(node.index);
        continue;
      }
      if (2 * node.index + 1 < levels_[node.level - 1].size()) stack[depth++] = {node.level - 1, 2 * node.index + 1};
      stack[depth++] = {node.level - 1, 2 * node.index};
    }
  }

  std::vector<std::uint32_t> order_;           // items in Morton order
  std::vector<FloatBox> boxes_;                // of order_[i]
  std::vector<std::vector<FloatBox>> levels_;  // [0] the leaves, the last one the root
};

/// The boxes of a mesh's triangles.
///
/// \pre Coordinates are float32 values and the mesh is not empty.
class TriangleTree : public BoxTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh, const Pulse& pulse = {});
};

}  // namespace aplomb::detail
