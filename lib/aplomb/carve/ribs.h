#pragma once

#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/carve/flat_ceilings.h"
#include "aplomb/carve/kept_parts.h"
#include "aplomb/volume/solid_volume.h"

namespace aplomb {

/// What it costs to keep what would be carved, for each upright column of a volume's lattice:
///
///     integral of -l over the carvable region where the plane l says to carve
///
/// which is, at first order, what the linear program loses by it (the reduced cost at its dual).
class ColumnCosts {
 public:
  ColumnCosts(const SolidVolume& volume, const AffineForm& kept);
  /// Per mm2 of plan.
  double at(Vec2 point_mm) const;

 private:
  VoxelFrame frame_;
  int columns_ = 0, rows_ = 0;
  std::vector<double> costs_;
};

struct RibOptions {
  double thick_mm = 1;  ///< of a rib, > 0
  double slot_mm = 9;   ///< most between two ribs, > 0
};

/// Upright sheets of material under cells of a ceiling, from it down to the floor, so that no slot between them is wider
/// than slot_mm. Of twelve directions and the places that leave no wider slot, those that cost least. At least one.
std::vector<KeptPart> ribs_under(const FlatCeiling& ceiling, const std::vector<int>& cells, const ColumnCosts& costs,
                                 const RibOptions& options, double floor_mm);

}  // namespace aplomb
