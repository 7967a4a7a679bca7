#include "aplomb/adapters/cgal/fill_polygon.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <exception>
#include <string>
#include <utility>

namespace aplomb::adapters {
namespace {

constexpr int unknown = -1;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Face =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// How many loops lie around every face, from the outside in.
void count_loops(Triangulation& triangulation) {
  for (auto face = triangulation.all_faces_begin(); face != triangulation.all_faces_end(); ++face)
    face->info() = unknown;
  std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()};
  open.front()->info() = 0;
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    for (int side = 0; side < 3; ++side) {
      const auto next = face->neighbor(side);
      if (next->info() != unknown) continue;
      next->info() = face->info() ^ (face->is_constrained(side) ? 1 : 0);
      open.push_back(next);
    }
  }
}

}  // namespace

Result<std::vector<Triangle>> fill_polygon(std::span<const Vec2> points_mm,
                                           std::span<const std::array<std::uint32_t, 2>> edges) {
  try {
    Triangulation triangulation;
    std::vector<Triangulation::Vertex_handle> handles;
    for (const Vec2& p : points_mm) {
      handles.push_back(triangulation.insert({p.x, p.y}));
      handles.back()->info() = static_cast<std::uint32_t>(handles.size() - 1);
    }
    for (const auto& [from, to] : edges) triangulation.insert_constraint(handles[from], handles[to]);
    if (triangulation.dimension() < 2) return std::vector<Triangle>();
    count_loops(triangulation);
    std::vector<Triangle> triangles;
    for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face)
      if (face->info() == 1)
        triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    return triangles;
  } catch (const std::exception& error) {
    return fail(ErrorCode::third_party, std::string("CGAL could not triangulate the cut: ") + error.what());
  }
}

}  // namespace aplomb::adapters
