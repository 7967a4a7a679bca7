#pragma once

#include <vector>

#include "aplomb/core/pulse.h"
#include "aplomb/volume/solid_volume.h"

namespace aplomb {

/// A cube of 8^3 cells of the carvable region.
struct CarvableBlock {
  static constexpr int size = 8;
  static constexpr int cells = size * size * size;

  VoxelIndex origin{};  ///< its least corner
  /// The carvable share of each cell, x slowest: 0 outside, 1 inside. Empty: all of it is carvable.
  std::vector<float> shares;
};

/// The region that a SolidVolume allows to carve, in a fixed order. Where the pulse stopped, a part of it.
std::vector<CarvableBlock> carvable_blocks(const SolidVolume& volume, const Pulse& pulse = {});

}  // namespace aplomb
