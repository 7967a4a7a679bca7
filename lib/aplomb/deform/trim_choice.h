#pragma once

#include <span>
#include <vector>

#include "aplomb/balance/standing_rows.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {

/// How far carving would go with so much cut off the base.
struct TrimGain {
  double trim_mm = 0;
  double t = 0;  ///< the largest that a void reaches: tan(tip angle)
};

/// Estimates what cutting off the base is worth, without voxelising: the support polygon is that of the cut, exactly;
/// the solid and what may be carved of it are the samples of one cage.
///
/// A trim of 0 is the solid as it is. Trims that leave nothing are left out.
///
/// \pre  pose.up is +z; wall_mm > 0; trims ascend.
/// \return cancelled, internal.
/// \par Cost  0.1 s a trim, and a cage.
Result<std::vector<TrimGain>> trim_gains(const SolidMesh& solid, const StandingPose& pose, RowKind kind, double wall_mm,
                                         std::span<const double> trims_mm, const Job& job = {});

/// The smallest of the trims that reaches required_t; if none does, the smallest that comes within 5 % of the most
/// that any of them gains; 0 where they gain less than 0.001. \pre gains ascend from a trim of 0.
double chosen_trim_mm(std::span<const TrimGain> gains, double required_t);

}  // namespace aplomb
