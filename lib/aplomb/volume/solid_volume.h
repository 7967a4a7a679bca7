#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/solid_mesh.h"
#include "aplomb/volume/voxel_frame.h"

namespace aplomb {

struct VolumeOptions {
  double wall_mm = 2;        ///< least material between a void and the outside, > 0
  double voxel_mm = 0.5;     ///< lattice spacing, > 0, at most half the wall
  double least_void_mm = 1;  ///< voids narrower than this are not carved; 0 carves any, at most 32 voxels
  std::size_t memory_bytes = std::size_t{4} << 30;  ///< refused before allocating when the estimate is over
};

/// What simplifying and rounding the shell may take from the wall, in voxels; carving keeps that much farther away.
inline constexpr double shell_slack_voxels = 0.08;

/// W of SolidVolume.
double carving_depth_mm(const VolumeOptions& options);

/// A sentence that names field, value and range; empty when there is nothing to say.
std::string find_problem(const VolumeOptions& options);

/// Where a solid may be carved: a sparse OpenVDB grid of
///
///     phi(x) = W - d(x)  mm,    W = sqrt(wall^2 + 3/4 voxel^2) + slack,    d = distance to the surface, inside
///     positive
///
/// (a solid's own voids are outside; a line from each to the outside counts as surface, so that its wall stays held)
///
/// at lattice points: carvable where negative. Exact (to float32) at every corner of a cell in which phi changes sign
/// and down to a depth of least_void / 2 below; clamped beyond. The distance of depths is exact everywhere: -phi is the
/// distance to where carving must end.
class SolidVolume {
 public:
  struct Impl;  ///< adapters/openvdb/grids.h

  explicit SolidVolume(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  const VoxelFrame& frame() const;
  const VolumeOptions& options() const;
  const Impl& impl() const { return *impl_; }

  /// Lattice points held in leaves, and the memory they take.
  std::size_t stored_points() const;
  std::size_t memory_bytes() const;

 private:
  std::shared_ptr<const Impl> impl_;
};

/// Samples where the solid may be carved. Instead of voxelising the surface and trusting the distances that spread
/// from it (OpenVDB's meshToVolume over-estimates them by up to 1.2 voxels at wall depth), an octree is descended with
/// exact distances: a node whose centre is farther from (or nearer to) depth W than its half diagonal is decided whole.
///
/// \pre  find_problem(options) is empty.
/// \return over_budget (with the estimate), cancelled.
/// \par Cost  about 8 distances (2 us each) per cell of the region's boundary, shared by the threads allowed.
Result<SolidVolume> voxelize(const SolidMesh& solid, const VolumeOptions& options, const Job& job = {});

/// Bytes that voxelize() and the stages after it would take, from the solid's area; compared with memory_bytes.
std::size_t estimated_bytes(const SolidMesh& solid, const VolumeOptions& options);

}  // namespace aplomb
