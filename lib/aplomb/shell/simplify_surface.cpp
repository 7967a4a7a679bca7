#include "aplomb/shell/simplify_surface.h"

#include <algorithm>
#include <vector>

#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/triangle_tree.h"
#include "aplomb/mesh/simplify.h"

namespace aplomb {
namespace {

constexpr int most_rounds = 10;
constexpr int rings = 2;  // of given triangles kept round a spoilt one

using Marks = std::vector<bool>;  // of given vertices

/// The triangles that cross others, or else those that the caller will not have.
Result<std::vector<std::uint32_t>> spoilt_triangles(const TriangleMesh& coarse, const FindSpoilt& find_spoilt,
                                                    const Job& job) {
  const std::vector<bool> none_skipped(coarse.triangles.size());  // simplify() makes no degenerate triangle
  const auto crossing =
      detail::crossing_triangles(coarse, detail::TriangleTree(coarse), none_skipped, job.part(0, 0.5));
  if (!crossing) return tl::unexpected(crossing.error());
  std::vector<std::uint32_t> spoilt;
  for (std::uint32_t t = 0; t < crossing->size(); ++t)
    if ((*crossing)[t]) spoilt.push_back(t);
  return spoilt.empty() ? find_spoilt(coarse, job.part(0.5, 1)) : spoilt;
}

/// Marks the given vertices near the spoilt triangles, and some rings round them.
void mark_near(const TriangleMesh& fine, const SimplifiedMesh& coarse, const std::vector<std::uint32_t>& spoilt,
               Marks& marks) {
  std::vector<bool> is_spoilt(coarse.mesh.triangles.size());
  std::vector<bool> is_corner(coarse.mesh.vertices.size());
  for (const std::uint32_t t : spoilt) {
    is_spoilt[t] = true;
    for (const std::uint32_t v : coarse.mesh.triangles[t]) is_corner[v] = true;
  }
  Marks near(fine.vertices.size());
  for (std::size_t v = 0; v < near.size(); ++v)
    if (coarse.triangle_near[v] != SimplifiedMesh::no_triangle) near[v] = is_spoilt[coarse.triangle_near[v]];
  for (std::size_t v = 0; v < is_corner.size(); ++v)
    if (is_corner[v]) near[coarse.given_vertices[v]] = true;
  for (int ring = 0; ring < rings; ++ring) {
    const Marks inner = near;
    for (const Triangle& t : fine.triangles)
      if (inner[t[0]] || inner[t[1]] || inner[t[2]]) near[t[0]] = near[t[1]] = near[t[2]] = true;
  }
  for (std::size_t v = 0; v < near.size(); ++v)
    if (near[v]) marks[v] = true;
}

}  // namespace

Result<TriangleMesh> simplified_surface(const TriangleMesh& fine, double deviation_mm, const FindSpoilt& find_spoilt,
                                        const Job& job) {
  if (!(deviation_mm > 0) || fine.triangles.empty()) return fine;
  Marks kept(fine.vertices.size());
  for (int round = 0; round < most_rounds; ++round) {
    const Job part = job.part(1 - 1.0 / (round + 1), 1 - 1.0 / (round + 2));  // half of what is left: most need one
    auto coarse = simplify(fine, deviation_mm, kept, part.part(0, 0.5));
    if (!coarse) return tl::unexpected(coarse.error());
    const auto spoilt = spoilt_triangles(coarse->mesh, find_spoilt, part.part(0.5, 1));
    if (!spoilt) return tl::unexpected(spoilt.error());
    if (spoilt->empty()) return std::move(coarse->mesh);
    mark_near(fine, *coarse, *spoilt, kept);
  }
  return fine;
}

}  // namespace aplomb
