#include "surface_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

namespace aplomb::bench {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct Edge {
  std::uint32_t from = 0, to = 0;
  std::array<std::uint32_t, 2> facets{};  // the first runs through it forwards
};

std::vector<Edge> edges_of(const TriangleMesh& mesh) {
  struct Half {
    std::uint32_t low, high, facet;
    bool forwards;
  };
  std::vector<Half> halves;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[f][k], b = mesh.triangles[f][(k + 1) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), f, a < b});
    }
  std::ranges::sort(halves, [](const Half& g, const Half& h) {
    return std::tuple(g.low, g.high, !g.forwards) < std::tuple(h.low, h.high, !h.forwards);
  });
  std::vector<Edge> edges;
  for (std::size_t n = 0; n + 1 < halves.size(); n += 2)
    edges.push_back({halves[n].low, halves[n].high, {halves[n].facet, halves[n + 1].facet}});
  return edges;
}

Vec3 scaled_normal(const TriangleMesh& mesh, std::uint32_t facet) {
  const Triangle& t = mesh.triangles[facet];
  const Vec3 a = mesh.vertices[t[0]];
  return cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
}

double dihedral_rad(const TriangleMesh& mesh, const Edge& edge) {
  const Vec3 m = scaled_normal(mesh, edge.facets[0]), n = scaled_normal(mesh, edge.facets[1]);
  const Vec3 along = normalized(mesh.vertices[edge.to] - mesh.vertices[edge.from]);
  return std::atan2(dot(along, cross(m, n)), dot(m, n));
}

/// The inverse of the transpose.
Mat3 cofactors(const Mat3& m) {
  const double d = determinant(m);
  return {{{cross(m.rows[1], m.rows[2]) / d, cross(m.rows[2], m.rows[0]) / d, cross(m.rows[0], m.rows[1]) / d}}};
}

/// The rotation of the polar decomposition (Higham 1986) as axis times angle.
Vec3 rotation_vector(Mat3 r) {
  for (int n = 0; n < 12; ++n) {
    const Mat3 other = cofactors(r);
    for (std::size_t row = 0; row < 3; ++row) r.rows[row] = 0.5 * (r.rows[row] + other.rows[row]);
  }
  const Vec3 axis = 0.5 * Vec3{r.rows[2].y - r.rows[1].z, r.rows[0].z - r.rows[2].x, r.rows[1].x - r.rows[0].y};
  const double sine = norm(axis), cosine = 0.5 * (r.rows[0].x + r.rows[1].y + r.rows[2].z - 1);
  return sine < 1e-12 ? Vec3{} : std::atan2(sine, cosine) / sine * axis;
}

/// Two edges and the unit normal, as columns.
Mat3 frame_of(const TriangleMesh& mesh, std::uint32_t facet) {
  const Triangle& t = mesh.triangles[facet];
  const Vec3 a = mesh.vertices[t[0]];
  return transposed({{{mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a, normalized(scaled_normal(mesh, facet))}}});
}

std::vector<Vec3> facet_rotations(const TriangleMesh& rest, const TriangleMesh& moved) {
  std::vector<Vec3> rotations;
  for (std::uint32_t f = 0; f < rest.triangles.size(); ++f)
    rotations.push_back(rotation_vector(frame_of(moved, f) * transposed(cofactors(frame_of(rest, f)))));
  return rotations;
}

double percentile(std::vector<double> values, double ratio) {
  const auto place = static_cast<std::ptrdiff_t>(ratio * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

void measure_creases(const TriangleMesh& rest, const TriangleMesh& moved, const std::vector<Edge>& edges,
                     SurfaceQuality& quality) {
  std::vector<double> changes;
  double squares = 0, area = 0;
  for (const Edge& edge : edges) {
    const double change = std::remainder(dihedral_rad(moved, edge) - dihedral_rad(rest, edge), 2 * std::numbers::pi);
    changes.push_back(std::abs(change) / degree);
    const double size = std::min(norm(scaled_normal(rest, edge.facets[0])), norm(scaled_normal(rest, edge.facets[1])));
    squares += size * changes.back() * changes.back();
    area += size;
  }
  quality.crease_rms_deg = std::sqrt(squares / area);
  quality.crease_p99_deg = percentile(changes, 0.99);
  quality.crease_max_deg = std::ranges::max(changes);
}

void measure_unevenness(const TriangleMesh& rest, const TriangleMesh& moved, const std::vector<Edge>& edges,
                        SurfaceQuality& quality) {
  const std::vector<Vec3> rotations = facet_rotations(rest, moved);
  std::vector<Vec3> around(rotations.size());
  for (const Edge& edge : edges) {
    around[edge.facets[0]] += rotations[edge.facets[1]] / 3;
    around[edge.facets[1]] += rotations[edge.facets[0]] / 3;
  }
  std::vector<double> values;
  double sum = 0, area = 0;
  for (std::uint32_t f = 0; f < rotations.size(); ++f) {
    const double size = norm(scaled_normal(rest, f));
    values.push_back(norm(rotations[f] - around[f]) / degree);
    sum += size * values.back();
    area += size;
  }
  quality.unevenness_mean_deg = sum / area;
  quality.unevenness_p99_deg = percentile(values, 0.99);
}

}  // namespace

SurfaceQuality measure_quality(const TriangleMesh& rest, const TriangleMesh& moved, const TriangleMesh& reference) {
  SurfaceQuality quality;
  const std::vector<Edge> edges = edges_of(rest);
  measure_creases(rest, moved, edges, quality);
  measure_unevenness(rest, moved, edges, quality);
  for (std::size_t v = 0; v < moved.vertices.size(); ++v)
    quality.mean_from_mm +=
        norm(moved.vertices[v] - reference.vertices[v]) / static_cast<double>(moved.vertices.size());
  return quality;
}

}  // namespace aplomb::bench
