#include "aplomb/printability/detail/surface_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "aplomb/mesh/detail/topology.h"

namespace aplomb::detail {
namespace {

double area_mm2(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.vertices[t[0]];
  return 0.5 * norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
}

/// Cells of the strips across a triangle's longest side. a, b: that side; c: the corner above it.
void add_cells(Vec3 a, Vec3 b, Vec3 c, double spacing, std::uint32_t triangle, std::vector<SurfaceSample>& samples) {
  const double length = norm(b - a), foot = dot(c - a, b - a) / (length * length);  // share of the side
  const double height = norm(c - a - foot * (b - a));
  const int strips = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  const Vec3 up = (c - a - foot * (b - a)) / height;
  for (int i = 0; i < strips; ++i) {
    const double u = (i + 0.5) / strips;
    const double rise = height * (u < foot ? u / foot : (1 - u) / (1 - foot));
    const int cells = std::max(1, static_cast<int>(std::ceil(rise / spacing)));
    for (int j = 0; j < cells; ++j)
      samples.push_back({a + u * (b - a) + ((j + 0.5) / cells * rise) * up, triangle, length / strips * rise / cells});
  }
}

struct Cell {
  std::array<std::int64_t, 3> index;
  friend bool operator==(const Cell&, const Cell&) = default;
};
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t hash = 0;
    for (const std::int64_t i : c.index) hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15U;
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

Cell cell_of(Vec3 point, double size) {
  return {{static_cast<std::int64_t>(std::floor(point.x / size)), static_cast<std::int64_t>(std::floor(point.y / size)),
           static_cast<std::int64_t>(std::floor(point.z / size))}};
}

}  // namespace

SurfaceSamples sample_surface(const TriangleMesh& mesh, double spacing_mm, std::size_t at_most, const Pulse& pulse) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += area_mm2(mesh, t);
  SurfaceSamples out{{}, std::max(spacing_mm, std::sqrt(area / static_cast<double>(at_most)))};
  const double s = out.spacing_mm;
  double owed = 0;  // area of small triangles without a sample
  for (std::uint32_t i = 0; i < mesh.triangles.size() && pulse.goes_on(); ++i) {
    const Triangle& t = mesh.triangles[i];
    std::array<Vec3, 3> p{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const std::array<double, 3> sides{norm(p[1] - p[0]), norm(p[2] - p[1]), norm(p[0] - p[2])};
    const auto longest = std::ranges::max_element(sides) - sides.begin();
    std::rotate(p.begin(), p.begin() + longest, p.end());
    if (const double own = area_mm2(mesh, t); own < s * s) {
      owed += own;
      if (owed < 0.25 * s * s && i + 1 < mesh.triangles.size()) continue;
      out.samples.push_back({(p[0] + p[1] + p[2]) / 3, i, owed});
      owed = 0;
    } else {
      add_cells(p[0], p[1], p[2], s, i, out.samples);
    }
  }
  return out;
}

std::vector<std::vector<std::uint32_t>> groups_within(const std::vector<Vec3>& points, double reach_mm,
                                                      const Pulse& pulse) {
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;
  DisjointSets sets(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!pulse.goes_on(5)) return {};
    const Cell home = cell_of(points[i], reach_mm);
    for (int n = 0; n < 27; ++n) {
      const Cell near{{home.index[0] + n / 9 - 1, home.index[1] + n / 3 % 3 - 1, home.index[2] + n % 3 - 1}};
      const auto found = cells.find(near);
      if (found == cells.end()) continue;
      for (const std::uint32_t other : found->second)
        if (squared_norm(points[other] - points[i]) <= reach_mm * reach_mm) sets.join(i, other);
    }
    cells[home].push_back(i);
  }
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::size_t> group_of(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint32_t root = sets.find(i);  // the smallest of its set: met first
    if (root == i) group_of[i] = groups.size(), groups.emplace_back();
    groups[group_of[root]].push_back(i);
  }
  return groups;
}

}  // namespace aplomb::detail
