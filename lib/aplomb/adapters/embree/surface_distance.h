#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::adapters {

/// Exact distances to a triangle mesh: Embree's bounding volume hierarchy finds the triangles, every distance to one
/// is computed here in double precision (Ericson, Real-Time Collision Detection, 5.1.5).
///
/// \par Cost  Building: 0.06 s for 100k triangles. A query: 1 to 4 us there, ten times less than CGAL's AABB tree.
class SurfaceDistance {
 public:
  static constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

  struct Closest {
    double distance_mm = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = no_triangle;  ///< one of the closest ones
  };

  /// \pre mesh is not empty; its coordinates are float32 values.
  explicit SurfaceDistance(const TriangleMesh& mesh);

  /// The closest triangle. `hint`, a triangle believed to be close, makes the search quicker and never changes
  /// the distance. A distance that is no more than `near_enough_mm` may be any that is not, and one of such a triangle.
  /// Safe to call from several threads.
  Closest closest(Vec3 point_mm, std::uint32_t hint = no_triangle, double near_enough_mm = 0) const;

  /// The least distance from a triangle, to rounding, or `at_most_mm` when that is not more.
  /// \pre a, b, c are not collinear. \par Cost  grows with the triangles within at_most_mm of it.
  double from_triangle(Vec3 a, Vec3 b, Vec3 c, double at_most_mm) const;

  /// A ball that touches a point of the surface and a triangle across the solid from it.
  struct Pinch {
    double radius_mm = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = no_triangle;
    Vec3 at_mm;  ///< where it touches that triangle
  };

  /// The least ball that touches a plane at `point_mm`, lies on the side `inward` of it and touches a triangle whose
  /// normal is within acos(least_cos) of `inward`; nothing when its radius would be `at_most_mm` or more.
  /// \pre inward has length 1. \par Cost  grows with the triangles within at_most_mm of its centre.
  Pinch pinch(Vec3 point_mm, Vec3 inward, double at_most_mm, double least_cos) const;

  /// The point of a triangle that is closest to a point.
  Vec3 closest_point(Vec3 point_mm, std::uint32_t triangle) const;

  /// Whether a point off the surface is inside, by the angle-weighted pseudonormal at its closest point
  /// (Baerentzen and Aanaes 2005). \pre The mesh is closed and oriented, without self-intersection;
  /// `nearest` was found for this point.
  bool inside(Vec3 point_mm, const Closest& nearest) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace aplomb::adapters
