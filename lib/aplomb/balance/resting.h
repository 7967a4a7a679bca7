#pragma once

#include <optional>
#include <vector>

#include "aplomb/balance/stability.h"

namespace aplomb {

/// A way for a solid to rest on the plate by itself.
struct RestingFace {
  Vec3 up;             ///< unit vector: a StandingPose with it rests on this face
  double tip_rad = 0;  ///< > 0
  double com_height_mm = 0;
  double area_mm2 = 0;  ///< of the support polygon
};

/// The faces of the convex hull on which the solid rests, the most stable first: those facets over which the centre of
/// mass lies, everything within contact_height_mm of one counted to it. Of facets of one face one is kept; of a
/// rounded thing's many the 64 lowest.
///
/// Of more than 20000 vertices the hull is that of the farthest vertex in each of 13824 directions from the box's
/// centre, which may leave out corners that stand out by less than a contact height or so, and never adds any.
///
/// \pre  body has a positive volume.
/// \return unusable_input for a flat mesh.
/// \par Cost  O(n), and at most 0.2 s for the hull.
Result<std::vector<RestingFace>> resting_faces(const TriangleMesh& mesh, const Moments& body, double contact_height_mm);

/// Why the way that is up looks like a mistake. Angles are measured with contacts up to 1 % of the box's diagonal high,
/// so that rounded soles count.
struct RestingHint {
  std::optional<Vec3> up;  ///< the axis that is meant, if there is one: the model has a base square to it
  double given_tip_rad = 0;
  double suggested_tip_rad = 0;  ///< with `up`
};

/// A hint when the solid is plainly lying down, or standing on its head or end. Either
///   - another axis has a resting face within 2 degrees of it and is steadier by 10 degrees, while the given way up has
///     no such face and no flat base (no contact larger than (5 % of the diagonal)^2); the steadiest one is named; or
///   - the given way falls by more than 15 degrees and is less than half as high as it is long; no axis is named.
///
/// Of 18 public figures 16 have a resting face within 1.5 degrees of their upright axis; two topple upright and have
/// none. All 16 are told from lying down, and upright all 18 are left alone (tests/unit/resting_models_test.cpp). Tip
/// angles alone would not do: most figures are steadiest on their side.
///
/// \pre as resting_faces; find_problem(pose) is empty.
std::optional<RestingHint> resting_hint(const TriangleMesh& mesh, const Moments& body, const StandingPose& pose);

}  // namespace aplomb
