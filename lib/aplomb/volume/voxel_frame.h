#pragma once

#include <array>
#include <cstdint>

#include "aplomb/core/vec.h"

namespace aplomb {

/// A lattice point of the voxel grid; not a place in millimetres. Only a VoxelFrame converts.
using VoxelIndex = std::array<std::int32_t, 3>;

/// Where the lattice lies in model space: index (0, 0, 0) at `origin_mm`, axes parallel, spacing `voxel_mm`.
struct VoxelFrame {
  double voxel_mm = 1;
  Vec3 origin_mm;

  Vec3 position_mm(VoxelIndex index) const {
    return origin_mm + voxel_mm * Vec3{double(index[0]), double(index[1]), double(index[2])};
  }
};

}  // namespace aplomb
