#include "aplomb/adapters/cgal/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <exception>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

namespace aplomb::adapters {
namespace {

/// CGAL's order follows the addresses of its nodes, which nobody chose: vertices by coordinates and triangles by their
/// vertices, each from its smallest one on, are the same in every run.
TriangleMesh in_its_own_order(const TriangleMesh& hull) {
  std::vector<std::uint32_t> order(hull.vertices.size()), rank(hull.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) {
    return std::tie(hull.vertices[i].x, hull.vertices[i].y, hull.vertices[i].z);
  };
  std::ranges::sort(order, {}, place);
  TriangleMesh mesh;
  for (const std::uint32_t i : order) {
    rank[i] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(hull.vertices[i]);
  }
  for (Triangle t : hull.triangles) {
    for (std::uint32_t& corner : t) corner = rank[corner];
    std::ranges::rotate(t, std::ranges::min_element(t));
    mesh.triangles.push_back(t);
  }
  std::ranges::sort(mesh.triangles);
  return mesh;
}

}  // namespace

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
