#include "aplomb/adapters/cgal/boolean.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <vector>

namespace aplomb::adapters {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// CGAL writes to stderr before it throws.
void make_quiet() {
  const auto ignore = [](const char*, const char*, const char*, int, const char*) {};
  CGAL::set_warning_handler(ignore);
  CGAL::set_error_handler(ignore);
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
}

SurfaceMesh surface_of(const TriangleMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x, v.y, v.z);
  std::vector<std::array<std::size_t, 3>> polygons;
  polygons.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) polygons.push_back({t[0], t[1], t[2]});
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

template <class Operation>
std::optional<TriangleMesh> combined(const TriangleMesh& body, const TriangleMesh& tool, const Operation& operation) {
  make_quiet();
  SurfaceMesh one = surface_of(body), other = surface_of(tool), result;
  if (!operation(one, other, result)) return std::nullopt;
  return triangles_of(result);
}

}  // namespace

std::optional<TriangleMesh> difference(const TriangleMesh& body, const TriangleMesh& tool) {
  return combined(body, tool, [](SurfaceMesh& one, SurfaceMesh& other, SurfaceMesh& result) {
    return PMP::corefine_and_compute_difference(one, other, result);
  });
}

std::optional<TriangleMesh> intersection(const TriangleMesh& body, const TriangleMesh& tool) {
  return combined(body, tool, [](SurfaceMesh& one, SurfaceMesh& other, SurfaceMesh& result) {
    return PMP::corefine_and_compute_intersection(one, other, result);
  });
}

}  // namespace aplomb::adapters
