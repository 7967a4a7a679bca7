#include "aplomb/carve/flat_ceilings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "aplomb/mesh/detail/topology.h"

namespace aplomb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least_area_mm2 = 0.5;

using Corners = std::array<Vec3, 3>;

Corners corners_of(const TriangleMesh& mesh, std::size_t t) {
  const Triangle& corners = mesh.triangles[t];
  return {mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]};
}

/// Marks the cells that a facet lies over, by points of it half a cell apart.
void draw(const Corners& facet, FlatCeiling& ceiling) {
  const double longest = std::max({norm(facet[1] - facet[0]), norm(facet[2] - facet[1]), norm(facet[0] - facet[2])});
  const int steps = 1 + static_cast<int>(longest / (0.5 * ceiling.cell_mm));
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      const Vec3 p = facet[0] + double(i) / steps * (facet[1] - facet[0]) + double(j) / steps * (facet[2] - facet[0]);
      const int column = static_cast<int>(std::lround((p.x - ceiling.origin_mm.x) / ceiling.cell_mm));
      const int row = static_cast<int>(std::lround((p.y - ceiling.origin_mm.y) / ceiling.cell_mm));
      double& top = ceiling.top_mm[static_cast<std::size_t>(row) * ceiling.columns + column];
      top = std::max(top, p.z);
    }
}

FlatCeiling drawn(const TriangleMesh& mesh, const std::vector<std::uint32_t>& facets, double cell_mm) {
  FlatCeiling ceiling;
  ceiling.cell_mm = cell_mm;
  for (const std::uint32_t t : facets)
    for (const Vec3& corner : corners_of(mesh, t)) ceiling.box_mm.add(corner);
  ceiling.origin_mm = {ceiling.box_mm.min.x - cell_mm, ceiling.box_mm.min.y - cell_mm};
  ceiling.columns = 4 + static_cast<int>(ceiling.box_mm.size().x / cell_mm);
  ceiling.rows = 4 + static_cast<int>(ceiling.box_mm.size().y / cell_mm);
  ceiling.top_mm.assign(static_cast<std::size_t>(ceiling.columns) * ceiling.rows, -infinity);
  for (const std::uint32_t t : facets) draw(corners_of(mesh, t), ceiling);
  return ceiling;
}

/// Lower envelope of parabolas (Felzenszwalb and Huttenlocher 2012): squared distances along one line, in cells.
void spread(std::vector<double>& values) {
  const int n = static_cast<int>(values.size());
  std::vector<double> out(values.size(), infinity), from(values.size() + 1);
  std::vector<int> at;
  const auto meeting = [&](int p, int q) { return (values[q] + q * q - values[p] - p * p) / (2.0 * (q - p)); };
  for (int q = 0; q < n; ++q) {
    if (values[q] == infinity) continue;
    while (at.size() > 1 && meeting(at.back(), q) <= from[at.size() - 1]) at.pop_back();
    from[at.size()] = at.empty() ? -infinity : meeting(at.back(), q);
    at.push_back(q);
  }
  std::size_t k = 0;
  for (int q = 0; q < n && !at.empty(); ++q) {
    while (k + 1 < at.size() && from[k + 1] < q) ++k;
    out[q] = (q - at[k]) * double(q - at[k]) + values[at[k]];
  }
  values = std::move(out);
}

/// Squared distances, in cells, to where `squared` is 0.
void spread_both_ways(std::vector<double>& squared, int columns, int rows) {
  std::vector<double> line;
  for (int row = 0; row < rows; ++row) {
    const auto begin = squared.begin() + std::ptrdiff_t(row) * columns;
    line.assign(begin, begin + columns);
    spread(line);
    std::ranges::copy(line, begin);
  }
  for (int column = 0; column < columns; ++column) {
    line.clear();
    for (int row = 0; row < rows; ++row) line.push_back(squared[std::size_t(row) * columns + column]);
    spread(line);
    for (int row = 0; row < rows; ++row) squared[std::size_t(row) * columns + column] = line[row];
  }
}

}  // namespace

std::vector<FlatCeiling> flat_ceilings(const TriangleMesh& shell, std::size_t first_triangle, double slope_deg,
                                       double cell_mm) {
  const double steep = std::cos(slope_deg * std::numbers::pi / 180);
  detail::DisjointSets sets(shell.vertices.size());
  std::vector<std::pair<std::uint32_t, double>> flat;  // and their areas
  for (std::size_t t = first_triangle; t < shell.triangles.size(); ++t) {
    const Corners facet = corners_of(shell, t);
    const Vec3 n = cross(facet[1] - facet[0], facet[2] - facet[0]);
    if (-n.z <= steep * norm(n)) continue;
    flat.emplace_back(static_cast<std::uint32_t>(t), norm(n) / 2);
    for (const std::uint32_t v : shell.triangles[t]) sets.join(v, shell.triangles[t][0]);
  }
  std::map<std::uint32_t, std::pair<std::vector<std::uint32_t>, double>> pieces;
  for (const auto& [t, area] : flat) {
    auto& [facets, sum] = pieces[sets.find(shell.triangles[t][0])];
    facets.push_back(t);
    sum += area;
  }
  std::vector<FlatCeiling> ceilings;
  for (const auto& [root, piece] : pieces)
    if (piece.second >= least_area_mm2) ceilings.push_back(drawn(shell, piece.first, cell_mm));
  return ceilings;
}

std::vector<int> wide_cells(const FlatCeiling& ceiling, double radius_mm) {
  const double radius = radius_mm / ceiling.cell_mm;
  const int count = ceiling.columns * ceiling.rows;
  std::vector<double> to_rim(static_cast<std::size_t>(count));
  for (int cell = 0; cell < count; ++cell) to_rim[cell] = ceiling.holds(cell) ? infinity : 0;
  spread_both_ways(to_rim, ceiling.columns, ceiling.rows);
  std::vector<double> to_core(to_rim.size());
  for (int cell = 0; cell < count; ++cell) to_core[cell] = std::sqrt(to_rim[cell]) - 0.5 > radius ? 0 : infinity;
  spread_both_ways(to_core, ceiling.columns, ceiling.rows);
  std::vector<int> wide;
  for (int cell = 0; cell < count; ++cell)
    if (ceiling.holds(cell) && std::sqrt(to_core[cell]) <= radius + 1.5) wide.push_back(cell);
  return wide;
}

}  // namespace aplomb
