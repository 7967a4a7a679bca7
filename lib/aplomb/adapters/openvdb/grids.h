#pragma once

// Private to the .cpp files of this folder: the only header of ours that names OpenVDB.

#include <openvdb/openvdb.h>

#include <array>

#include "aplomb/carve/void_field.h"
#include "aplomb/volume/solid_volume.h"

namespace aplomb {

/// Negative inside. Leaves hold lattice points; active tiles of 8^3 hold -background, deep inside; the rest is
/// +background.
struct SolidVolume::Impl {
  VoxelFrame frame;
  VolumeOptions options;
  openvdb::FloatGrid::ConstPtr field;
};

struct VoidField::Impl {
  VoxelFrame frame;
  openvdb::FloatGrid::ConstPtr field;
};

namespace adapters {

using FieldTree = openvdb::FloatTree;
using FieldLeaf = FieldTree::LeafNodeType;
/// Thread-safe while the tree is only read; not registered with it, and so cheap to make.
using FieldReader = openvdb::tree::ValueAccessor<const FieldTree, false>;

constexpr int leaf_size = 8;
constexpr int corner_size = leaf_size + 1;
constexpr int corner_count = corner_size * corner_size * corner_size;

/// Values at the corners of the 8^3 cells whose least corner lies in a leaf; x slowest, as in OpenVDB's leaves.
using CornerValues = std::array<float, corner_count>;

constexpr int corner_offset(int i, int j, int k) { return (i * corner_size + j) * corner_size + k; }

/// Gathers a leaf's corner values from it and its neighbours.
CornerValues corner_values(const FieldReader& reader, const openvdb::Coord& origin);

}  // namespace adapters
}  // namespace aplomb
