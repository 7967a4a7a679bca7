#pragma once

#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

/// Closed, outward-wound meshes of shapes whose volume, centroid and support polygon are known.
namespace aplomb::test {

TriangleMesh box(Vec3 min, Vec3 max);

/// Four corners in any order; wound outward.
TriangleMesh tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

/// A convex counter-clockwise base at z = bottom_mm, swept straight to the same polygon displaced by `sweep`.
/// \pre sweep.z > 0.
TriangleMesh prism(const std::vector<Vec2>& base, double bottom_mm, Vec3 sweep);

/// A box of the given width (x) and depth (y), centred over the origin at z = 0, whose top is displaced by
/// lean_mm in +x. Its centroid stands over the base's edge when lean_mm = width_mm, and its tip angle is then
/// 0.
TriangleMesh leaning_prism(double width_mm, double depth_mm, double height_mm, double lean_mm);

/// The corners of a regular polygon around the origin, counter-clockwise, the first on the +x axis.
std::vector<Vec2> regular_polygon(double radius_mm, int segments);

/// A frustum over a regular polygon, from base_mm up; a radius of 0 gives an apex. Not both radii may be 0.
TriangleMesh frustum(Vec3 base_mm, double bottom_radius_mm, double top_radius_mm, double height_mm, int segments);
TriangleMesh cylinder(Vec3 base_mm, double radius_mm, double height_mm, int segments);
TriangleMesh cone(Vec3 base_mm, double radius_mm, double height_mm, int segments);

/// An icosahedron subdivided `subdivisions` times (20 * 4^n triangles), every vertex at the radius, two of
/// them at the poles.
TriangleMesh sphere(Vec3 center_mm, double radius_mm, int subdivisions);

/// Around the z axis through the centre; quads split in two.
TriangleMesh torus(Vec3 center_mm, double major_radius_mm, double minor_radius_mm, int major_segments,
                   int minor_segments);

/// `outer` with the region of `inner` taken out: inner's surface reversed. \pre inner lies strictly inside
/// outer.
TriangleMesh with_void(TriangleMesh outer, TriangleMesh inner);

Affine3 translation(Vec3 by_mm);
Affine3 scaling(double factor);
/// About an axis through the origin, right-handed.
Affine3 rotation(Vec3 axis, double angle_rad);

}  // namespace aplomb::test
