#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aplomb/mesh/triangle_mesh.h"

/// What the adapters of CGAL's operations on surfaces share.
namespace aplomb::adapters {

using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<SurfaceKernel::Point_3>;

/// CGAL writes to stderr before it throws; its generator is a global.
inline void make_quiet_and_deterministic() {
  const auto ignore = [](const char*, const char*, const char*, int, const char*) {};
  CGAL::set_warning_handler(ignore);
  CGAL::set_error_handler(ignore);
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  CGAL::get_default_random() = CGAL::Random(0);
}

/// `prepare(points, polygons)` may change both before they become a surface.
template <class Prepare>
SurfaceMesh surface_of(const TriangleMesh& mesh, const Prepare& prepare) {
  std::vector<SurfaceKernel::Point_3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x, v.y, v.z);
  std::vector<std::array<std::size_t, 3>> polygons;
  polygons.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) polygons.push_back({t[0], t[1], t[2]});
  prepare(points, polygons);
  SurfaceMesh surface;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, polygons, surface);
  return surface;
}

inline SurfaceMesh surface_of(const TriangleMesh& mesh) {
  return surface_of(mesh, [](const auto&, const auto&) {});
}

inline TriangleMesh triangles_of(const SurfaceMesh& surface) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> numbers(surface.number_of_vertices() + surface.number_of_removed_vertices());
  for (const auto v : surface.vertices()) {
    numbers[v.idx()] = static_cast<std::uint32_t>(mesh.vertices.size());
    const SurfaceKernel::Point_3& p = surface.point(v);
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

}  // namespace aplomb::adapters
