#include "aplomb/carve/moment_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "aplomb/mesh/clipped_tetrahedron.h"

namespace aplomb {
namespace {

/// Cells of a block, x slowest.
Vec3 cell_index(int cell) {
  const int i = cell / 64, j = cell / 8 % 8, k = cell % 8;
  return {double(i), double(j), double(k)};
}

Moments uniform_cube(Vec3 origin, double size) {
  const double volume = size * size * size;
  return {volume, volume * (origin + 0.5 * size * Vec3{1, 1, 1})};
}

/// A form over the unit cube, s(u) = constant + slope . u, positive where the cube is counted.
struct UnitCut {
  double constant;
  Vec3 slope;

  /// Without a component near zero: the antidifference divides by their product.
  bool is_oblique() const {
    const auto [least, greatest] = std::minmax({std::abs(slope.x), std::abs(slope.y), std::abs(slope.z)});
    return least >= 1e-2 * greatest;
  }

  /// Of { s > 0 } in the unit cube.
  Moments moments() const { return is_oblique() ? antidifference() : by_tetrahedra(); }

 private:
  Moments by_tetrahedra() const {
    std::array<double, 8> kept{};
    for (int c = 0; c < 8; ++c)
      kept[c] = -constant - dot(slope, Vec3{double(c & 1), double(c >> 1 & 1), double(c >> 2 & 1)});
    return negative_part_of_unit_cube(kept);
  }

  Moments antidifference() const {
    double volume = 0;
    Vec3 first;
    for (int c = 0; c < 8; ++c) {
      const Vec3 corner{double(c & 1), double(c >> 1 & 1), double(c >> 2 & 1)};
      const double s = std::max(0.0, constant + dot(slope, corner));
      const double sign = (c & 1) ^ (c >> 1 & 1) ^ (c >> 2 & 1) ? 1 : -1;  // (-1)^(3 - |c|)
      const double cube = s * s * s / 6, fourth = s * s * s * s / 24;
      volume += sign * cube;
      first += sign * (cube * corner - Vec3{fourth / slope.x, fourth / slope.y, fourth / slope.z});
    }
    const double product = slope.x * slope.y * slope.z;
    return {volume / product, first / product};
  }
};

}  // namespace

Moments cut_cube(const AffineForm& form, Vec3 origin_mm, double size_mm) {
  const double middle = form(origin_mm + 0.5 * size_mm * Vec3{1, 1, 1});
  const Vec3 g = form.gradient;
  if (std::abs(middle) >= 0.5 * size_mm * (std::abs(g.x) + std::abs(g.y) + std::abs(g.z)))
    return middle > 0 ? Moments{} : uniform_cube(origin_mm, size_mm);
  const Vec3 slope = -size_mm * g;
  const UnitCut cut{-middle - 0.5 * (slope.x + slope.y + slope.z), slope};
  const Moments unit = cut.moments();
  const double volume = size_mm * size_mm * size_mm;
  return {volume * unit.volume_mm3, volume * (unit.volume_mm3 * origin_mm + size_mm * unit.first_mm4)};
}

MomentTree::MomentTree(const std::vector<CarvableBlock>& blocks, const VoxelFrame& frame)
    : blocks_(blocks), frame_(frame) {
  if (blocks_.empty()) return;
  std::vector<std::uint32_t> order(blocks_.size());
  std::iota(order.begin(), order.end(), 0u);
  nodes_.reserve(2 * blocks_.size());
  root_ = build(order, 0, order.size());
  total_ = nodes_[root_].moments;
}

MomentTree::Node MomentTree::leaf_node(std::uint32_t index) const {
  const CarvableBlock& block = blocks_[index];
  const double h = frame_.voxel_mm;
  const Vec3 origin = frame_.position_mm(block.origin);
  Node node;
  node.block = static_cast<std::int32_t>(index);
  node.box.add(origin);
  node.box.add(origin + CarvableBlock::size * h * Vec3{1, 1, 1});
  if (block.shares.empty()) {
    node.moments = uniform_cube(origin, CarvableBlock::size * h);
    return node;
  }
  for (int cell = 0; cell < CarvableBlock::cells; ++cell)
    if (block.shares[cell] > 0) {
      const Vec3 corner = origin + h * cell_index(cell);
      node.moments += double(block.shares[cell]) * uniform_cube(corner, h);
    }
  return node;
}

std::int32_t MomentTree::build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end) {
  const auto push = [&](const Node& node) {
    nodes_.push_back(node);
    return static_cast<std::int32_t>(nodes_.size() - 1);
  };
  if (end - begin == 1) return push(leaf_node(order[begin]));
  std::array<std::int32_t, 3> least = blocks_[order[begin]].origin, greatest = least;
  for (std::size_t i = begin; i < end; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], blocks_[order[i]].origin[axis]);
      greatest[axis] = std::max(greatest[axis], blocks_[order[i]].origin[axis]);
    }
  int widest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (greatest[axis] - least[axis] > greatest[widest] - least[widest]) widest = axis;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto before = [&](std::uint32_t a, std::uint32_t b) {  // a total order, so that the tree is always the same
    return std::pair(blocks_[a].origin[widest], a) < std::pair(blocks_[b].origin[widest], b);
  };
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end, before);
  std::sort(order.begin() + begin, order.begin() + middle);  // nth_element promises no order within the halves
  std::sort(order.begin() + middle, order.begin() + end);
  Node node;
  node.left = build(order, begin, middle);
  node.right = build(order, middle, end);
  for (const std::int32_t child : {node.left, node.right}) {
    node.box.add(nodes_[child].box.min);
    node.box.add(nodes_[child].box.max);
    node.moments += nodes_[child].moments;
  }
  return push(node);
}

Moments MomentTree::not_positive_part(const AffineForm& form) const {
  Moments sum;
  if (root_ >= 0) add_part(root_, form, sum);
  return sum;
}

void MomentTree::add_part(std::int32_t index, const AffineForm& form, Moments& sum) const {
  const Node& node = nodes_[index];
  const Vec3 half = 0.5 * node.box.size();
  const double middle = form(node.box.min + half);
  const Vec3 g = form.gradient;
  const double reach = std::abs(g.x) * half.x + std::abs(g.y) * half.y + std::abs(g.z) * half.z;
  if (middle - reach > 0) return;
  if (middle + reach <= 0) {
    sum += node.moments;
  } else if (node.block >= 0) {
    sum += block_part(blocks_[node.block], form);
  } else {
    add_part(node.left, form, sum);
    add_part(node.right, form, sum);
  }
}

Moments MomentTree::block_part(const CarvableBlock& block, const AffineForm& form) const {
  const double h = frame_.voxel_mm;
  const Vec3 origin = frame_.position_mm(block.origin), g = form.gradient;
  if (block.shares.empty()) return cut_cube(form, origin, CarvableBlock::size * h);
  const double reach = 0.5 * h * (std::abs(g.x) + std::abs(g.y) + std::abs(g.z));
  Moments sum;
  for (int cell = 0; cell < CarvableBlock::cells; ++cell) {
    if (block.shares[cell] == 0) continue;
    const Vec3 corner = origin + h * cell_index(cell);
    const double middle = form(corner + 0.5 * h * Vec3{1, 1, 1});
    if (middle - reach > 0) continue;
    sum += double(block.shares[cell]) * (middle + reach <= 0 ? uniform_cube(corner, h) : cut_cube(form, corner, h));
  }
  return sum;
}

}  // namespace aplomb
