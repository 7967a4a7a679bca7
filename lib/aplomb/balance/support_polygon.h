#pragma once

#include <vector>

#include "aplomb/balance/pose.h"
#include "aplomb/core/error.h"
#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// An edge that a standing solid tips over: the plate's half-plane { q : inward . (q - from) >= 0 } holds the
/// polygon.
struct SupportEdge {
  Vec2 from_mm, to_mm;  ///< counter-clockwise; equal where a degenerate polygon ends
  Vec2 inward;          ///< unit normal
};

/// What a solid stands on: the convex hull of its contacts, seen from above, in the plate coordinates of its
/// pose.
struct SupportPolygon {
  PlateFrame frame;  ///< the plate goes through the solid's lowest point
  std::vector<Vec2>
      corners_mm;        ///< counter-clockwise and strictly convex; two ends, or one point, where it is degenerate
  double height_mm = 0;  ///< of the whole solid, from the plate to its highest point

  /// Fewer than three contacts that are not in line: nothing can stand on them.
  bool degenerate() const { return corners_mm.size() < 3; }
  double area_mm2() const;
  /// The smallest altitude: the least distance between two parallel lines that hold the polygon between them.
  double width_mm() const;
  std::vector<Vec3> corners_in_model_mm() const;
  /// The edges counter-clockwise from corner 0. A degenerate polygon has four: a segment both ways and its
  /// two ends, a point along +-x and +-y. So every polygon is the set of plate points inside all of its
  /// edges.
  std::vector<SupportEdge> edges() const;
};

/// The convex hull of the part of the solid's surface that touches the plate: within pose.contact_height_mm
/// of the lowest point (the vertices down there, and where edges cross that height) and, where the pose names
/// contacts, within one of their balls. Where a ball's rim cuts through a triangle the rim is replaced by a
/// 128-gon inside it.
///
/// \pre  find_problem(pose) is empty.
/// \return unusable_input for a mesh without triangles; invalid_option when no named contact touches the
/// plate, with
///         the height at which it would. Too few contacts are no error: see degenerate().
/// \par Cost  O(n + k log k) for k points that touch; 30 ms for 2 million triangles.
Result<SupportPolygon> support_polygon(const TriangleMesh& mesh, const StandingPose& pose);

}  // namespace aplomb
