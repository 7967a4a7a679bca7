#include "aplomb/adapters/cgal/surface_repair.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>

#include <array>

namespace aplomb::adapters {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// CGAL writes to stderr before it throws; its generator is a global.
void make_quiet_and_deterministic() {
  const auto ignore = [](const char*, const char*, const char*, int, const char*) {};
  CGAL::set_warning_handler(ignore);
  CGAL::set_error_handler(ignore);
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  CGAL::get_default_random() = CGAL::Random(0);
}

SurfaceMesh surface_of(const TriangleMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x, v.y, v.z);
  std::vector<std::array<std::size_t, 3>> polygons;
  polygons.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) polygons.push_back({t[0], t[1], t[2]});
  PMP::orient_polygon_soup(points, polygons);
  SurfaceMesh surface;
  PMP::polygon_soup_to_polygon_mesh(points, polygons, surface);
  return surface;
}

TriangleMesh triangles_of(const SurfaceMesh& surface) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> numbers(surface.number_of_vertices() + surface.number_of_removed_vertices());
  for (const auto v : surface.vertices()) {
    numbers[v.idx()] = static_cast<std::uint32_t>(mesh.vertices.size());
    const Kernel::Point_3& p = surface.point(v);
    mesh.vertices.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : surface.faces()) {
    Triangle t{};
    std::size_t corner = 0;
    for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface)) t[corner++ % 3] = numbers[v.idx()];
    mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace

ClosedSurface closed_surface(const TriangleMesh& soup) {
  make_quiet_and_deterministic();
  SurfaceMesh surface = surface_of(soup);
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
      const Kernel::Point_3& p = surface.point(CGAL::target(h, surface));
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
  SurfaceMesh all = surface_of(bodies.at(0));
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    SurfaceMesh next = surface_of(bodies[i]), result;
    if (!PMP::corefine_and_compute_union(all, next, result, CGAL::parameters::throw_on_self_intersection(true)))
      return std::nullopt;
    all = std::move(result);
  }
  return triangles_of(all);
}

std::optional<TriangleMesh> without_self_intersections(const TriangleMesh& mesh) {
  make_quiet_and_deterministic();
  SurfaceMesh surface = surface_of(mesh);
  PMP::experimental::remove_self_intersections(surface, CGAL::parameters::preserve_genus(false));
  if (!CGAL::is_closed(surface)) return std::nullopt;
  return triangles_of(surface);
}

}  // namespace aplomb::adapters
