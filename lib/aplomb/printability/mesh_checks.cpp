#include "aplomb/printability/mesh_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aplomb/adapters/cgal/exact_predicates.h"
#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/detail/triangle_tree.h"
#include "aplomb/mesh/mass_properties.h"

namespace aplomb {
namespace {

constexpr int roundtrip_sections = 32;

/// Gathers the first point of something and a box round all of it.
class Spot {
 public:
  void add(Vec3 point) {
    if (box_.empty()) first_ = point;
    box_.add(point);
  }
  std::vector<Place> place(std::size_t count) const { return {{static_cast<double>(count), first_, box_}}; }

 private:
  Vec3 first_;
  Box3 box_;
};

void find_bad_edges(const TriangleMesh& mesh, Spot& spot) {
  detail::EdgeTable(mesh).for_each([&](std::uint32_t low, std::uint32_t high, std::span<const detail::Corner> corners) {
    const auto is_up = [&](std::size_t n) { return detail::vertex_at(mesh, corners[n]) == low; };
    if (corners.size() == 2 && is_up(0) != is_up(1)) return;
    spot.add(mesh.vertices[low]);
    spot.add(mesh.vertices[high]);
  });
}

std::vector<bool> find_degenerate(const TriangleMesh& mesh, Spot& spot) {
  std::vector<bool> degenerate(mesh.triangles.size());
  for (std::size_t t = 0; t < degenerate.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    degenerate[t] =
        a == b || b == c || c == a || adapters::are_collinear(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    if (degenerate[t]) spot.add(mesh.vertices[a]);
  }
  return degenerate;
}

Result<void> find_crossings(const TriangleMesh& mesh, const std::vector<bool>& degenerate, Spot& spot, const Job& job) {
  const auto crossing = detail::crossing_triangles(mesh, detail::TriangleTree(mesh), degenerate, job);
  if (!crossing) return tl::unexpected(crossing.error());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if ((*crossing)[t])
      for (const std::uint32_t v : mesh.triangles[t]) spot.add(mesh.vertices[v]);
  return {};
}

/// Signed area of the section at a height, by Green's formula over the segments in which triangles cross it.
double section_area_mm2(const TriangleMesh& mesh, double z) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    std::optional<Vec3> up, down;  // where the triangle's boundary crosses upward and downward
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = mesh.vertices[t[k]], &b = mesh.vertices[t[(k + 1) % 3]];
      if ((a.z >= z) == (b.z >= z)) continue;
      (b.z >= z ? up : down) = a + (z - a.z) / (b.z - a.z) * (b - a);
    }
    if (up && down) area += 0.5 * (up->x * down->y - down->x * up->y);
  }
  return std::abs(area);
}

}  // namespace

Result<MeshMeasures> measure_mesh(const TriangleMesh& mesh, const Job& job) {
  const auto check = check_solid(mesh, job.part(0, 0.5));
  if (!check) return tl::unexpected(check.error());
  const MeshDefects& defects = check->defects;
  Spot edges, degenerate, crossings;
  const TriangleMesh rounded = rounded_to_float(mesh);
  if (!defects.none()) {
    find_bad_edges(rounded, edges);
    const std::vector<bool> is_degenerate = find_degenerate(rounded, degenerate);
    if (const auto found = find_crossings(rounded, is_degenerate, crossings, job.part(0.5, 1)); !found)
      return tl::unexpected(found.error());
  }
  return MeshMeasures{edges.place(defects.open_edges + defects.nonmanifold_edges + defects.nonmanifold_vertices +
                                  defects.flipped_edges),
                      Spot().place(defects.misoriented_shells), crossings.place(defects.self_intersections),
                      degenerate.place(defects.degenerate_triangles + defects.duplicate_triangles), check->solid};
}

double roundtrip_error_ratio(const TriangleMesh& meant, const TriangleMesh& read) {
  if (meant.triangles.size() != read.triangles.size()) return std::numeric_limits<double>::infinity();
  const double volume = moments(meant).volume_mm3;
  double worst = std::abs(moments(read).volume_mm3 - volume) / std::abs(volume);
  const Box3 box = bounding_box(meant);
  for (int n = 0; n < roundtrip_sections; ++n) {
    const double z = box.min.z + (n + 0.5) / roundtrip_sections * box.size().z;
    const double area = section_area_mm2(meant, z);
    worst = std::max(worst, std::abs(section_area_mm2(read, z) - area) / std::max(area, 1e-9));
  }
  return worst;
}

}  // namespace aplomb
