#include "aplomb/mesh/solid_mesh.h"

#include <cmath>
#include <utility>

#include "aplomb/adapters/cgal/exact_predicates.h"
#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/nesting.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/detail/triangle_tree.h"

namespace aplomb {
namespace {

using detail::Components;
using detail::Corner;
using detail::EdgeTable;
using detail::next_corner;
using detail::vertex_at;

constexpr std::uint32_t triangles_a_step = 16;  // about a microsecond

std::vector<bool> degenerate_triangles(const TriangleMesh& mesh, const Pulse& pulse) {
  std::vector<bool> degenerate(mesh.triangles.size());
  for (std::size_t i = 0; i < degenerate.size(); ++i) {
    if (i % triangles_a_step == 0 && !pulse.goes_on()) break;
    const auto [a, b, c] = mesh.triangles[i];
    degenerate[i] =
        a == b || b == c || c == a || adapters::are_collinear(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  }
  return degenerate;
}

void count_edge_defects(const TriangleMesh& mesh, const EdgeTable& edges, MeshDefects& defects, const Pulse& pulse) {
  const auto count = [&](std::uint32_t low, std::uint32_t, std::span<const Corner> corners) {
    defects.open_edges += corners.size() == 1;
    defects.nonmanifold_edges += corners.size() > 2;
    defects.flipped_edges +=
        corners.size() == 2 && (vertex_at(mesh, corners[0]) == low) == (vertex_at(mesh, corners[1]) == low);
  };
  edges.for_each(count, pulse);
}

/// Counted where a duplicate is met: along the edge between its two lowest vertices.
std::size_t count_duplicates(const TriangleMesh& mesh, const EdgeTable& edges, const Pulse& pulse) {
  std::size_t duplicates = 0;
  std::vector<std::uint32_t> apexes;
  const auto count = [&](std::uint32_t, std::uint32_t high, std::span<const Corner> corners) {
    if (corners.size() < 2) return;
    apexes.clear();
    for (const Corner c : corners) {
      const std::uint32_t apex = vertex_at(mesh, next_corner(next_corner(c)));
      if (apex > high) apexes.push_back(apex);
    }
    std::sort(apexes.begin(), apexes.end());
    duplicates += static_cast<std::size_t>(apexes.end() - std::unique(apexes.begin(), apexes.end()));
  };
  edges.for_each(count, pulse);
  return duplicates;
}

/// The corners round a vertex are one fan when edges join them all.
std::size_t count_nonmanifold_vertices(const TriangleMesh& mesh, const EdgeTable& edges, const Pulse& pulse) {
  detail::DisjointSets fans(3 * mesh.triangles.size());
  const auto join = [&](std::uint32_t low, std::uint32_t, std::span<const Corner> corners) {
    const auto at = [&](Corner c, bool at_low) { return (vertex_at(mesh, c) == low) == at_low ? c : next_corner(c); };
    for (const Corner c : corners.subspan(1))
      for (const bool at_low : {true, false}) fans.join(at(corners[0], at_low), at(c, at_low));
  };
  edges.for_each(join, pulse);
  std::vector<std::uint8_t> fans_at(mesh.vertices.size());
  std::size_t nonmanifold = 0;
  for (Corner c = 0; c < 3 * mesh.triangles.size(); ++c) {
    if (c % triangles_a_step == 0 && !pulse.goes_on()) break;
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

  const Pulse pulse(job, 0, "check");
  SolidCheck check;
  MeshDefects& defects = check.defects;
  const std::vector<bool> degenerate = degenerate_triangles(mesh, pulse);
  defects.degenerate_triangles = static_cast<std::size_t>(std::count(degenerate.begin(), degenerate.end(), true));
  const EdgeTable edges(mesh, pulse);
  count_edge_defects(mesh, edges, defects, pulse);
  defects.duplicate_triangles = count_duplicates(mesh, edges, pulse);
  defects.nonmanifold_vertices = count_nonmanifold_vertices(mesh, edges, pulse);
  const bool closed = defects.none();

  if (pulse.stopped()) return cancelled();
  const detail::TriangleTree tree(mesh, pulse);
  if (pulse.stopped()) return cancelled();
  const Result<std::size_t> crossings = count_crossings(mesh, tree, degenerate, job);
  if (!crossings) return tl::unexpected(crossings.error());
  defects.self_intersections = *crossings;
  if (!closed) return check;

  const Pulse after(job, 1, "check");
  Components components = edge_components(mesh, edges, after);
  if (after.stopped()) return cancelled();
  const std::vector<double> volumes = detail::volumes_mm3(mesh, components);
  if (*crossings > 0) {  // nesting means nothing then, but a lone shell has an inside
    defects.misoriented_shells = components.count == 1 && volumes[0] < 0;
    return check;
  }
  detail::Nesting nesting(mesh, edges, components, after);
  if (after.stopped()) return cancelled();
  auto windings = nesting.windings(job.part(1, 1));
  if (!windings) return tl::unexpected(windings.error());
  std::size_t voids = 0;
  for (std::uint32_t c = 0; c < components.count; ++c) {
    const bool is_void = volumes[c] < 0;
    voids += is_void;
    defects.misoriented_shells += windings->sums[c] != (is_void ? 1 : 0);
  }
  if (!defects.none()) return check;
  check.solid = SolidMeshMaker::make(std::move(mesh), components.count - voids, voids);
  check.prints = detail::numbered(std::move(components), windings->sets);  // nothing of a solid touches or crosses
  return check;
}

}  // namespace aplomb
