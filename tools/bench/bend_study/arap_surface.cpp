#include "arap_surface.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include <limits>

namespace aplomb::bench {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using VertexHandle = SurfaceMesh::Vertex_index;
using Deformation = CGAL::Surface_mesh_deformation<SurfaceMesh, CGAL::Default, CGAL::Default, CGAL::SRE_ARAP>;

SurfaceMesh surface_of(const TriangleMesh& mesh) {
  SurfaceMesh surface;
  for (const Vec3& v : mesh.vertices) surface.add_vertex({v.x, v.y, v.z});
  for (const Triangle& t : mesh.triangles) surface.add_face(VertexHandle(t[0]), VertexHandle(t[1]), VertexHandle(t[2]));
  return surface;
}

/// The held vertices and, until none is farther than spacing_mm from one of these, the farthest.
std::vector<bool> spread_controls(const TriangleMesh& mesh, const std::vector<bool>& held, double spacing_mm) {
  std::vector<bool> controls = held;
  std::vector<double> distance(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  const auto add = [&](std::size_t control) {
    controls[control] = true;
    for (std::size_t v = 0; v < distance.size(); ++v)
      distance[v] = std::min(distance[v], norm(mesh.vertices[v] - mesh.vertices[control]));
  };
  for (std::size_t v = 0; v < held.size(); ++v)
    if (held[v] && distance[v] > spacing_mm / 4) add(v);  // of a dense sole some will do
  for (;;) {
    const auto farthest = std::ranges::max_element(distance);
    if (*farthest <= spacing_mm) return controls;
    add(static_cast<std::size_t>(farthest - distance.begin()));
  }
}

/// Moves every control to where `guess` has it. False where the system could not be factorised.
bool deform(Deformation& deformation, const TriangleMesh& guess, const std::vector<bool>& controls, int iterations) {
  for (std::uint32_t v = 0; v < controls.size(); ++v) {
    if (controls[v]) deformation.insert_control_vertex(VertexHandle(v));
    else deformation.erase_control_vertex(VertexHandle(v));
  }
  if (!deformation.preprocess()) return false;
  for (std::uint32_t v = 0; v < controls.size(); ++v) {
    const Vec3 to = guess.vertices[v];
    if (controls[v]) deformation.set_target_position(VertexHandle(v), {to.x, to.y, to.z});
  }
  deformation.deform(static_cast<unsigned>(iterations), 0);
  return true;
}

}  // namespace

std::optional<TriangleMesh> arap_surface(const TriangleMesh& rest, const TriangleMesh& guess,
                                         const std::vector<bool>& held, const ArapOptions& options) {
  SurfaceMesh surface = surface_of(rest);
  Deformation deformation(surface);
  deformation.set_sre_arap_alpha(options.alpha_ratio);
  const auto all = vertices(surface);
  deformation.insert_roi_vertices(all.begin(), all.end());
  // All held: the surface is the guess, and the rotations kept are those that suit it.
  if (!deform(deformation, guess, std::vector<bool>(held.size(), true), 1)) return std::nullopt;
  const std::vector<bool> controls = spread_controls(rest, held, options.spacing_mm);
  if (!deform(deformation, guess, controls, options.iterations)) return std::nullopt;
  TriangleMesh out = guess;
  for (std::uint32_t v = 0; v < controls.size(); ++v) {
    const Point& p = surface.point(VertexHandle(v));
    out.vertices[v] = {p.x(), p.y(), p.z()};
  }
  return rounded_to_float(std::move(out));
}

}  // namespace aplomb::bench
