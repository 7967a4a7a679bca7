#pragma once

#include <string>

#include "aplomb/balance/hanging.h"
#include "aplomb/balance/standing.h"
#include "aplomb/core/error.h"
#include "aplomb/mesh/triangle_mesh.h"
#include "picture.h"

namespace aplomb::picture {

/// A figure with what is measured of it.
struct Figure {
  TriangleMesh mesh;  ///< z up, its lowest point on z = 0
  Standing standing;
  Affine3 down;  ///< from the mesh as it came
};

/// Turns the pose's up upward, puts the lowest point on the plate and measures at density 1. `inserts` are what weighs
/// besides the mesh, as so much of its material.
/// \return unusable_input for a mesh without positive volume; what measure_standing() returns.
Result<Figure> stood_up(TriangleMesh mesh, StandingPose pose, const Moments& inserts = {});

/// A body as it comes to rest on its threads.
struct Hung {
  Subject subject;      ///< the threads upward, the lowest point on z = 0
  Affine3 down;         ///< from the mesh as it came
  std::string verdict;  ///< "hangs askew by 2.3 degrees", with the degree sign
};
/// \return unusable_input for a mesh without positive volume.
Result<Hung> hung(TriangleMesh mesh, const HangingPose& pose, const Moments& inserts = {});

/// With its support polygon and centre of mass.
Subject drawn(const Figure& figure);

/// The figure as its tip angle says: upright when it stands, fallen over its weak edge when it does not.
Subject as_it_comes_to_rest(const Figure& figure);

/// From where a fall is seen from the side, going to the right, a little from the front.
double azimuth_for_rad(Vec3 heading);

/// The vertical plane through the point along `heading`, opened towards the viewer.
Cut section_along(Vec3 point_mm, Vec3 heading, double azimuth_rad);

/// "falls" or "stands to 12.3 degrees", with the degree sign.
std::string verdict(const Figure& figure);

}  // namespace aplomb::picture
