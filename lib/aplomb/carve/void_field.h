#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/core/error.h"
#include "aplomb/core/pulse.h"
#include "aplomb/mesh/marching_tetrahedra.h"
#include "aplomb/volume/solid_volume.h"

namespace aplomb {

/// A void as a sampled field: negative inside, its surface the zero of the linear interpolation on Kuhn's tetrahedra.
/// It lies in the region that its SolidVolume allows. No value is within 0.05 voxel of zero.
class VoidField {
 public:
  struct Impl;  ///< adapters/openvdb/grids.h

  VoidField() = default;  ///< no void at all
  VoidField(std::shared_ptr<const Impl> impl, const Moments& moments) : impl_(std::move(impl)), moments_(moments) {}
  /// \pre !empty().
  const VoxelFrame& frame() const;
  /// Of the polyhedron that marching tetrahedra make of this field (to its float32 values).
  const Moments& moments() const { return moments_; }
  bool empty() const { return moments_.volume_mm3 <= 0; }
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
  Moments moments_;
};

struct VoidCut {
  VoidField field;
  std::size_t dropped_parts = 0;  ///< connected parts under least_volume_mm3
  double dropped_mm3 = 0;
  /// The same volume where the dropped parts may no longer be carved; set when there were any.
  std::optional<SolidVolume> without_dropped;
};

/// Carves where `kept` is not positive: phi_void = max(phi, kept / |gradient|), opened by a ball of the volume's
/// least_void_mm (up to half a voxel, so that sharp edges of a void stay sharp), without the parts smaller than
/// `least_volume_mm3`. The maximum only ever raises phi, so that the wall's guarantee holds for every such void.
/// \return cancelled.
Result<VoidCut> cut_void(const SolidVolume& volume, const AffineForm& kept, double least_volume_mm3,
                         const Job& job = {});

/// The same volume, where the part of a void that hangs together with a point of it, below a height, may no longer be
/// carved. Nothing changes where the seed lies outside the void.
SolidVolume without_part(const SolidVolume& volume, const VoidField& field, Vec3 seed_mm, double below_mm);

/// The cells in which the field changes sign, for marching_tetrahedra(). Where the pulse stopped, not all of them.
std::vector<CornerCell> boundary_cells(const VoidField& field, const Pulse& pulse = {});

}  // namespace aplomb
