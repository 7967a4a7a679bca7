#include "aplomb/adapters/cgal/surface_repair.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <array>

#include "aplomb/adapters/cgal/mesh_order.h"
#include "aplomb/adapters/cgal/surface_mesh.h"

namespace aplomb::adapters {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

SurfaceMesh oriented_surface_of(const TriangleMesh& mesh) {
  return surface_of(mesh, [](auto& points, auto& polygons) { PMP::orient_polygon_soup(points, polygons); });
}

}  // namespace

ClosedSurface closed_surface(const TriangleMesh& soup) {
  make_quiet_and_deterministic();
  SurfaceMesh surface = oriented_surface_of(soup);
  PMP::stitch_borders(surface);
  PMP::duplicate_non_manifold_vertices(surface);
  ClosedSurface closed;
  std::vector<SurfaceMesh::Halfedge_index> rims;
  PMP::extract_boundary_cycles(surface, std::back_inserter(rims));
  for (const SurfaceMesh::Halfedge_index rim : rims) {
    FilledHole hole;
    Box3 box;
    for (const auto h : CGAL::halfedges_around_face(rim, surface)) {
      ++hole.edges;
      const SurfaceKernel::Point_3& p = surface.point(CGAL::target(h, surface));
      box.add({p.x(), p.y(), p.z()});
    }
    hole.diameter_mm = box.diagonal();
    std::vector<SurfaceMesh::Face_index> patch;
    PMP::triangulate_hole(surface, rim, std::back_inserter(patch), CGAL::parameters::use_delaunay_triangulation(true));
    if (patch.empty()) {
      ++closed.holes_left;
      continue;
    }
    for (const auto f : patch) hole.area_mm2 += PMP::face_area(f, surface);
    closed.holes.push_back(hole);
  }
  closed.mesh = triangles_of(surface);
  return closed;
}

std::optional<TriangleMesh> united(const std::vector<TriangleMesh>& bodies) {
  make_quiet_and_deterministic();
  std::array<SurfaceMesh, 2> operands;  // CGAL asks which has the lower address
  auto& [all, next] = operands;
  all = oriented_surface_of(bodies.at(0));
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    next = oriented_surface_of(bodies[i]);
    SurfaceMesh result;
    if (!PMP::corefine_and_compute_union(all, next, result, CGAL::parameters::throw_on_self_intersection(true)))
      return std::nullopt;
    all = surface_of(in_its_own_order(triangles_of(result)));
  }
  return triangles_of(all);
}

std::optional<TriangleMesh> without_self_intersections(const TriangleMesh& mesh) {
  make_quiet_and_deterministic();
  SurfaceMesh surface = oriented_surface_of(mesh);
  PMP::experimental::remove_self_intersections(surface, CGAL::parameters::preserve_genus(false));
  if (!CGAL::is_closed(surface)) return std::nullopt;
  return triangles_of(surface);
}

}  // namespace aplomb::adapters
