#pragma once

#include <cstdint>
#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/mesh/mass_properties.h"
#include "aplomb/volume/carvable_blocks.h"

namespace aplomb {

/// Moments of the part of the cube origin + [0, size]^3 where the form is not positive.
///
/// With s(x) = -form(x), the volume is the third antidifference of the step function over the corners,
///
///     V = sum over corners c of (-1)^|c| s(c)_+^3 / 6 / (g_1 g_2 g_3),     g = -gradient,
///
/// and the first moments come by parts (Scardovelli and Zaleski 2000 for the volume). Where a component of g
/// is under 1e-2 of the largest, which would cost digits, the cube is clipped as six tetrahedra.
Moments cut_cube(const AffineForm& form, Vec3 origin_mm, double size_mm);

/// Moments of a carvable region, summed up a tree of boxes, so that those of its part on one side of a plane cost the
/// boxes that the plane cuts and no others.
class MomentTree {
 public:
  MomentTree(const std::vector<CarvableBlock>& blocks, const VoxelFrame& frame);

  /// Of the whole region.
  const Moments& total() const { return total_; }

  /// Of the part where the form is not positive. Cells that the plane cuts count by their part; the region within one
  /// cell is taken as evenly spread.
  Moments not_positive_part(const AffineForm& form) const;

 private:
  struct Node {
    Box3 box;
    Moments moments;
    std::int32_t left = -1, right = -1;  // children; none: a block
    std::int32_t block = -1;
  };

  std::int32_t build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end);
  Node leaf_node(std::uint32_t block) const;
  void add_part(std::int32_t node, const AffineForm& form, Moments& sum) const;
  Moments block_part(const CarvableBlock& block, const AffineForm& form) const;

  std::vector<CarvableBlock> blocks_;
  VoxelFrame frame_;
  std::vector<Node> nodes_;
  std::int32_t root_ = -1;
  Moments total_;
};

}  // namespace aplomb
