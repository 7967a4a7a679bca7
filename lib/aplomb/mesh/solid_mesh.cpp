#include "aplomb/mesh/solid_mesh.h"

#include <cmath>
#include <utility>

#include "aplomb/adapters/cgal/exact_predicates.h"
#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/detail/triangle_tree.h"

namespace aplomb {
namespace {

using detail::Components;
using detail::Corner;
using detail::EdgeTable;
using detail::next_corner;
using detail::vertex_at;

std::vector<bool> degenerate_triangles(const TriangleMesh& mesh) {
  std::vector<bool> degenerate(mesh.triangles.size());
  for (std::size_t i = 0; i < degenerate.size(); ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    degenerate[i] =
        a == b || b == c || c == a || adapters::are_collinear(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  }
  return degenerate;
}

void count_edge_defects(const TriangleMesh& mesh, const EdgeTable& edges, MeshDefects& defects) {
  edges.for_each([&](std::uint32_t low, std::uint32_t, std::span<const Corner> corners) {
    defects.open_edges += corners.size() == 1;
    defects.nonmanifold_edges += corners.size() > 2;
    defects.flipped_edges +=
        corners.size() == 2 && (vertex_at(mesh, corners[0]) == low) == (vertex_at(mesh, corners[1]) == low);
  });
}

/// Counted where a duplicate is met: along the edge between its two lowest vertices.
std::size_t count_duplicates(const TriangleMesh& mesh, const EdgeTable& edges) {
  std::size_t duplicates = 0;
  std::vector<std::uint32_t> apexes;
  edges.for_each([&](std::uint32_t, std::uint32_t high, std::span<const Corner> corners) {
    if (corners.size() < 2) return;
    apexes.clear();
    for (const Corner c : corners) {
      const std::uint32_t apex = vertex_at(mesh, next_corner(next_corner(c)));
      if (apex > high) apexes.push_back(apex);
    }
    std::sort(apexes.begin(), apexes.end());
    duplicates += static_cast<std::size_t>(apexes.end() - std::unique(apexes.begin(), apexes.end()));
  });
  return duplicates;
}

/// The corners round a vertex are one fan when edges join them all.
std::size_t count_nonmanifold_vertices(const TriangleMesh& mesh, const EdgeTable& edges) {
  detail::DisjointSets fans(3 * mesh.triangles.size());
  edges.for_each([&](std::uint32_t low, std::uint32_t, std::span<const Corner> corners) {
    const auto at = [&](Corner c, bool at_low) { return (vertex_at(mesh, c) == low) == at_low ? c : next_corner(c); };
    for (const Corner c : corners.subspan(1))
      for (const bool at_low : {true, false}) fans.join(at(corners[0], at_low), at(c, at_low));
  });
  std::vector<std::uint8_t> fans_at(mesh.vertices.size());
  std::size_t nonmanifold = 0;
  for (Corner c = 0; c < 3 * mesh.triangles.size(); ++c) {
    if (fans.find(c) != c) continue;
    std::uint8_t& fan_count = fans_at[vertex_at(mesh, c)];
    if (fan_count < 2 && ++fan_count == 2) ++nonmanifold;
  }
  return nonmanifold;
}

TriangleMesh without_unused_vertices(TriangleMesh mesh) {
  std::vector<bool> used(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  if (std::find(used.begin(), used.end(), false) == used.end()) return mesh;
  return detail::submesh(mesh, [](std::uint32_t) { return true; });
}

void append(std::string& text, std::size_t count, const char* one, const char* many) {
  if (count == 0) return;
  if (!text.empty()) text += ", ";
  text +=
      (count >= detail::most_crossings ? "at least " : "") + std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

std::string describe(const MeshDefects& defects) {
  std::string text;
  append(text, defects.open_edges, "open edge", "open edges");
  append(text, defects.nonmanifold_edges, "edge of more than two triangles", "edges of more than two triangles");
  append(text, defects.nonmanifold_vertices, "vertex where parts only touch", "vertices where parts only touch");
  append(text, defects.flipped_edges, "edge between flipped triangles", "edges between flipped triangles");
  append(text, defects.degenerate_triangles, "degenerate triangle", "degenerate triangles");
  append(text, defects.duplicate_triangles, "duplicate triangle", "duplicate triangles");
  append(text, defects.self_intersections, "self-intersection", "self-intersections");
  append(text, defects.misoriented_shells, "misoriented shell", "misoriented shells");
  return text.empty() ? "no defect" : text;
}

struct SolidMeshMaker {
  static SolidMesh make(TriangleMesh mesh, std::size_t bodies, std::size_t voids) {
    SolidMesh solid;
    solid.moments_ = aplomb::moments(mesh);
    solid.box_ = bounding_box(mesh);
    solid.mesh_ = std::make_shared<const TriangleMesh>(std::move(mesh));
    solid.bodies_ = bodies;
    solid.voids_ = voids;
    return solid;
  }
};

Result<SolidCheck> check_solid(const TriangleMesh& given, const Job& job) {
  if (given.triangles.empty()) return fail(ErrorCode::unusable_input, "the mesh has no triangles");
  TriangleMesh mesh = without_unused_vertices(rounded_to_float(given));
  const Box3 box = bounding_box(mesh);
  if (!std::isfinite(box.diagonal()) || !(box.diagonal() < 1e30))
    return fail(ErrorCode::unusable_input, "a coordinate is too large to be a length in millimetres");

  SolidCheck check;
  MeshDefects& defects = check.defects;
  const std::vector<bool> degenerate = degenerate_triangles(mesh);
  defects.degenerate_triangles = static_cast<std::size_t>(std::count(degenerate.begin(), degenerate.end(), true));
  const EdgeTable edges(mesh);
  count_edge_defects(mesh, edges, defects);
  defects.duplicate_triangles = count_duplicates(mesh, edges);
  defects.nonmanifold_vertices = count_nonmanifold_vertices(mesh, edges);
  const bool closed = defects.none();

  const detail::TriangleTree tree(mesh);
  const Result<std::size_t> crossings = count_crossings(mesh, tree, degenerate, job);
  if (!crossings) return tl::unexpected(crossings.error());
  defects.self_intersections = *crossings;
  if (!closed) return check;

  const Components components = edge_components(mesh, edges);
  const std::vector<double> volumes = detail::volumes_mm3(mesh, components);
  if (*crossings > 0) {  // nesting means nothing then, but a lone shell has an inside
    defects.misoriented_shells = components.count == 1 && volumes[0] < 0;
    return check;
  }
  const auto enclosing = enclosures(mesh, tree, components);
  std::size_t voids = 0;
  for (std::uint32_t c = 0; c < components.count; ++c) {
    const bool is_void = volumes[c] < 0;
    voids += is_void;
    int winding = 0;
    for (const detail::Enclosure& enclosure : enclosing[c]) winding += enclosure.winding;
    defects.misoriented_shells += winding != (is_void ? 1 : 0);
  }
  if (defects.none()) check.solid = SolidMeshMaker::make(std::move(mesh), components.count - voids, voids);
  return check;
}

}  // namespace aplomb
