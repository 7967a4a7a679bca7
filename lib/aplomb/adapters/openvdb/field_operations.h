#pragma once

// Private to the .cpp files of this folder.

#include <vector>

#include "aplomb/adapters/openvdb/grids.h"
#include "aplomb/core/pulse.h"

namespace aplomb::adapters {

/// The blocks of 8^3 cells that may have a negative corner: the least corners of the leaves, and of the active tiles,
/// whose cells are inside altogether; in the tree's order.
struct Blocks {
  std::vector<openvdb::Coord> mixed;
  std::vector<openvdb::Coord> full;
};
Blocks field_blocks(const FieldTree& field);

/// Makes leaves of the active tiles with a cell that reaches up to a positive point beyond them, as raising points
/// beside a tile leaves some.
void split_tiles_at_the_rim(FieldTree& field);

/// The eight corner values of a cell of a block, corner c at (c & 1, c >> 1 & 1, c >> 2 & 1).
std::array<double, 8> cell_values(const CornerValues& corners, int i, int j, int k);

/// Moments of the polyhedron that marching tetrahedra make.
Moments field_moments(const FieldTree& field, const VoxelFrame& frame);

/// Raises the field where no ball of `radius` (in the field's unit) that lies inside reaches within `slack`:
/// field(x) = max(field(x), min over p with field(p) <= -radius of |x - p| + field(p) - slack).
/// Interior distances must be exact down to -radius. Where the pulse stopped, the field is of no use.
void open_by_ball(FieldTree& field, double radius, double slack, double voxel, const Pulse& pulse);

struct DroppedParts {
  std::size_t parts = 0;
  std::size_t points = 0;
};

/// Raises face-connected negative parts of fewer than `least_points` lattice points above zero. Where the pulse
/// stopped, the field is of no use.
DroppedParts drop_small_parts(FieldTree& field, std::size_t least_points, const Pulse& pulse);

/// Moves values within `gap` of zero to +gap, so that no surface vertex falls on a lattice point.
void push_from_zero(FieldTree& field, float gap);

}  // namespace aplomb::adapters
