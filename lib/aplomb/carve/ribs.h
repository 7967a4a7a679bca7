#pragma once

#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/carve/flat_ceilings.h"
#include "aplomb/carve/kept_parts.h"
#include "aplomb/core/pulse.h"
#include "aplomb/volume/solid_volume.h"

namespace aplomb {

/// What it costs to keep what would be carved, for each upright column of a volume's lattice:
///
///     integral of -l over the carvable region where the plane l says to carve
///
/// which is, at first order, what the linear program loses by it (the reduced cost at its dual).
class ColumnCosts {
 public:
  /// Where the pulse stopped, of no use.
  ColumnCosts(const SolidVolume& volume, const AffineForm& kept, const Pulse& pulse = {});

  struct Column {
    double cost = 0;      ///< per mm2 of plan
    double floor_mm = 0;  ///< lowest place that would be carved, where the cost is not 0
    double top_mm = 0;    ///< highest
  };
  Column at(Vec2 point_mm) const;

 private:
  VoxelFrame frame_;
  int columns_ = 0, rows_ = 0;
  std::vector<Column> in_order_;
};

struct RibOptions {
  double thick_mm = 1;    ///< of a rib, > 0
  double slot_mm = 9;     ///< most between two ribs, > 0
  double slope_deg = 47;  ///< of the arches in a rib, from level; 90: a rib has none
  double floor_mm = 0;    ///< where ribs end
};

/// Upright sheets of material under cells of a ceiling, from it down to the floor, so that no slot between them is
/// wider than slot_mm. Of twelve directions and the places that leave no wider slot, those that cost least. At least
/// one.
///
/// A rib is cut out in pointed arches as steep as slope_deg where that gains something. What is left is whole for
/// 2 thick_mm under the ceiling that it holds, falls off as steeply as an overhang may until it meets the wall or the
/// floor, and stands on legs between arches and where no wall is near, a quarter as wide as they are high. So it prints
/// whatever lies beside it.
std::vector<KeptPart> ribs_under(const FlatCeiling& ceiling, const std::vector<int>& cells, const ColumnCosts& costs,
                                 const RibOptions& options);

}  // namespace aplomb
