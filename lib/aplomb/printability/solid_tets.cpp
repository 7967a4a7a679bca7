#include "aplomb/printability/solid_tets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "aplomb/adapters/tetgen/tetrahedralize.h"
#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/shell/simplify_surface.h"

namespace aplomb {
namespace {

constexpr std::size_t few_triangles = 3500;
constexpr IsolationLimits tetgen_limits{60, 2048};

/// How far along the ray it meets the triangle (Moeller and Trumbore); infinite where it does not.
double distance_along(Vec3 from, Vec3 towards, Vec3 a, Vec3 b, Vec3 c) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const Vec3 across = cross(towards, c - a);
  const double determinant = dot(b - a, across);
  if (determinant == 0) return never;
  const double u = dot(from - a, across) / determinant;
  const Vec3 q = cross(from - a, b - a);
  const double v = dot(towards, q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return never;
  const double t = dot(c - a, q) / determinant;
  return t > 0 ? t : never;
}

/// A point inside a void: half way from the middle of its largest triangle to what is across.
Vec3 point_inside(const TriangleMesh& mesh, const std::vector<std::uint32_t>& void_triangles) {
  const auto corner = [&](std::size_t t, std::size_t k) { return mesh.vertices[mesh.triangles[t][k]]; };
  const auto doubled_area = [&](std::size_t t) {
    return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
  };
  const std::uint32_t start =
      *std::ranges::max_element(void_triangles, {}, [&](std::uint32_t t) { return squared_norm(doubled_area(t)); });
  const Vec3 from = (corner(start, 0) + corner(start, 1) + corner(start, 2)) / 3;
  const Vec3 towards = normalized(doubled_area(start));  // out of the material
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (t != start)
      nearest = std::min(nearest, distance_along(from, towards, corner(t, 0), corner(t, 1), corner(t, 2)));
  return from + nearest / 2 * towards;
}

std::vector<Vec3> void_points(const TriangleMesh& mesh) {
  const detail::Components components = detail::edge_components(mesh, detail::EdgeTable(mesh));
  const std::vector<double> volumes = detail::volumes_mm3(mesh, components);
  std::vector<std::vector<std::uint32_t>> triangles(components.count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) triangles[components.of_triangle[t]].push_back(t);
  std::vector<Vec3> points;
  for (std::uint32_t shell = 0; shell < components.count; ++shell)
    if (volumes[shell] < 0) points.push_back(point_inside(mesh, triangles[shell]));
  return points;
}

Result<std::vector<std::uint32_t>> nothing_spoilt(const TriangleMesh&, const Job&) {
  return std::vector<std::uint32_t>{};
}

}  // namespace

Result<SolidTets> solid_tets(const SolidMesh& solid, const TetCounts& counts, const Job& job) {
  const adapters::TetrahedraSize size{solid.moments().volume_mm3 / static_cast<double>(counts.few), 2.5};
  constexpr std::array deviations{2e-4, 4e-4, 8e-4, 1.6e-3, 3.2e-3};  // of the diagonal
  std::size_t found = 0;
  for (std::size_t n = 0; n < deviations.size(); ++n) {
    const bool is_last = n + 1 == deviations.size();
    const Job part = job.part(1 - 1.0 / static_cast<double>(n + 1), 1 - 1.0 / static_cast<double>(n + 2));
    const double deviation_mm = deviations[n] * solid.box().diagonal();
    const auto coarse = simplified_surface(solid.mesh(), deviation_mm, nothing_spoilt, part.part(0, 0.4));
    if (!coarse) return tl::unexpected(coarse.error());
    if (coarse->triangles.size() > few_triangles && !is_last) continue;
    auto tets = adapters::tetrahedralize(*coarse, void_points(*coarse), size, tetgen_limits, part.part(0.4, 1));
    if (!tets && (is_last || tets.error().code == ErrorCode::cancelled)) return tl::unexpected(tets.error());
    if (!tets) continue;
    found = tets->tets.size();
    if (found <= counts.most) return SolidTets{std::move(*tets), deviation_mm};
  }
  return fail(ErrorCode::over_budget,
              fmt::format("elasticity would take {} tetrahedra; at most {} are allowed", found, counts.most));
}

TetSurface surface_of(const TetMesh& mesh) {
  constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  struct Face {
    Triangle key, wound;
  };
  std::vector<Face> all;
  all.reserve(4 * mesh.tets.size());
  for (const TetMesh::Tet& tet : mesh.tets)
    for (const auto& face : faces) {
      const Triangle wound{tet[face[0]], tet[face[1]], tet[face[2]]};
      all.push_back({detail::sorted(wound), wound});
    }
  std::ranges::sort(all, {}, &Face::key);
  TetSurface surface;
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mesh.vertices.size(), none);
  for (std::size_t f = 0; f < all.size(); ++f) {
    if ((f > 0 && all[f - 1].key == all[f].key) || (f + 1 < all.size() && all[f + 1].key == all[f].key)) continue;
    Triangle triangle = all[f].wound;
    for (std::uint32_t& v : triangle) {
      if (number[v] == none) {
        number[v] = static_cast<std::uint32_t>(surface.tet_vertices.size());
        surface.tet_vertices.push_back(v);
        surface.mesh.vertices.push_back(mesh.vertices[v]);
      }
      v = number[v];
    }
    surface.mesh.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace aplomb
