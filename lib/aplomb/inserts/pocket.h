#pragma once

#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/inserts/insert.h"
#include "aplomb/mesh/mass_properties.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// How pockets are made.
struct PocketRules {
  double layer_mm = 0.2;    ///< > 0: floors and ceilings lie between two layers
  double beside_mm = 0.25;  ///< all round between insert and wall: what printed holes come out too narrow, and a fit
  double above_mm = 0.05;   ///< least play between insert and ceiling; less than a layer more comes of whole layers
  double bridge_mm = 9.4;   ///< widest span of a ceiling, > 0
  double slope_deg = 47;    ///< of a ceiling that nothing holds, from level
};

/// Closed empty space round an upright axis, with inserts of one kind in it, one on another. It is open, as wide as it
/// gets, until the printer pauses; what is printed then is its ceiling:
///
/// - over coins, which fill the pocket and bear the ceiling (the play is about a layer), rings a layer high, each
///   reaching in by at most half a bridge, until what is left is a bridge;
/// - over balls, which bear it in one point alone, a cone as steep as a ceiling must be, until it is a bridge.
///
/// Under balls the floor is half a ball. Heights count from the lowest point of the floor.
struct Pocket {
  Insert insert;
  int stacked = 1;
  std::vector<Vec2> profile;  ///< radius (x) and height (y), upward, from the axis to the axis
  double open_mm = 0;         ///< where the ceiling begins: the print pauses when all below is printed
  double height_mm = 0;       ///< where it ends
  double radius_mm = 0;       ///< the largest
  double inserts_at_mm = 0;   ///< height of the inserts' centre of mass

  double mass_g() const { return stacked * insert.mass_g; }
};

/// \pre The insert is sound, stacked >= 1, the rules' numbers are positive.
Pocket pocket_for(const Insert& insert, int stacked, const PocketRules& rules);

/// Its surface over a regular polygon that holds the circle, wound outward; `floor_mm` is the lowest point of its axis.
TriangleMesh pocket_mesh(const Pocket& pocket, Vec3 floor_mm);

/// Of what pocket_mesh() encloses.
Moments pocket_moments(const Pocket& pocket, Vec3 floor_mm);

}  // namespace aplomb
