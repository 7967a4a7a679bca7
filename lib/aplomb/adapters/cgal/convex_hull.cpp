#include "aplomb/adapters/cgal/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <exception>
#include <string>
#include <vector>

#include "aplomb/adapters/cgal/mesh_order.h"

namespace aplomb::adapters {

Result<TriangleMesh> convex_hull(std::span<const Vec3> points_mm) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  try {
    std::vector<Kernel::Point_3> points;
    points.reserve(points_mm.size());
    for (const Vec3& p : points_mm) points.emplace_back(p.x, p.y, p.z);
    Mesh hull;
    if (points.size() >= 4) CGAL::convex_hull_3(points.begin(), points.end(), hull);
    if (hull.number_of_faces() < 4)
      return fail(ErrorCode::unusable_input, "all points lie in one plane, so they bound no solid");
    TriangleMesh mesh;
    for (const auto vertex : hull.vertices()) {
      const Kernel::Point_3& p = hull.point(vertex);
      mesh.vertices.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto face : hull.faces()) {
      std::vector<std::uint32_t> corners;
      for (const auto vertex : hull.vertices_around_face(hull.halfedge(face))) corners.push_back(vertex.idx());
      for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
    return in_its_own_order(mesh);
  } catch (const std::exception& error) {
    return fail(ErrorCode::third_party, std::string("CGAL could not make the convex hull: ") + error.what());
  }
}

}  // namespace aplomb::adapters
