#include "aplomb/printability/elasticity.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "aplomb/printability/detail/quadratic_tet.h"

namespace aplomb {

using detail::Lame;
using detail::shape_gradients;
using detail::tet_edges;
using detail::tet_shape;
using detail::TetShape;

QuadraticTets quadratic_tets(const TetMesh& mesh) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> edges;
  edges.reserve(6 * mesh.tets.size());
  const auto edge_of = [](const TetMesh::Tet& tet, const std::array<std::size_t, 2>& ends) {
    return Edge(std::minmax(tet[ends[0]], tet[ends[1]]));
  };
  for (const TetMesh::Tet& tet : mesh.tets)
    for (const auto& ends : tet_edges) edges.push_back(edge_of(tet, ends));
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  QuadraticTets result{mesh.vertices, {}};
  for (const auto& [a, b] : edges) result.nodes.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
  for (const TetMesh::Tet& tet : mesh.tets) {
    QuadraticTets::Tet& nodes = result.tets.emplace_back();
    std::ranges::copy(tet, nodes.begin());
    for (std::size_t e = 0; e < 6; ++e) {
      const auto found = std::ranges::lower_bound(edges, edge_of(tet, tet_edges[e]));
      nodes[4 + e] = static_cast<std::uint32_t>(mesh.vertices.size() + std::size_t(found - edges.begin()));
    }
  }
  return result;
}

namespace detail {

TetShape tet_shape(const QuadraticTets& mesh, std::size_t tet) {
  const auto at = [&](std::size_t corner) { return mesh.nodes[mesh.tets[tet][corner]]; };
  const Vec3 a = at(1) - at(0), b = at(2) - at(0), c = at(3) - at(0);
  const double six_volumes = dot(a, cross(b, c));
  TetShape shape;
  shape.gradients[1] = cross(b, c) / six_volumes;
  shape.gradients[2] = cross(c, a) / six_volumes;
  shape.gradients[3] = cross(a, b) / six_volumes;
  shape.gradients[0] = -(shape.gradients[1] + shape.gradients[2] + shape.gradients[3]);
  shape.volume_mm3 = six_volumes / 6;
  return shape;
}

std::array<Vec3, 10> shape_gradients(const TetShape& shape, const std::array<double, 4>& place) {
  std::array<Vec3, 10> gradients;
  for (std::size_t i = 0; i < 4; ++i) gradients[i] = (4 * place[i] - 1) * shape.gradients[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = tet_edges[e];
    gradients[4 + e] = 4 * (place[i] * shape.gradients[j] + place[j] * shape.gradients[i]);
  }
  return gradients;
}

}  // namespace detail

namespace {

Stress stress_of(const Lame& lame, const QuadraticTets::Tet& nodes, const NodalField& moved,
                 const std::array<Vec3, 10>& gradients) {
  Stress strain;  // its off-diagonal entries are the engineer's, doubled
  for (std::size_t n = 0; n < 10; ++n) {
    const Vec3 u = moved[nodes[n]], g = gradients[n];
    strain =
        strain +
        Stress{u.x * g.x, u.y * g.y, u.z * g.z, u.x * g.y + u.y * g.x, u.y * g.z + u.z * g.y, u.z * g.x + u.x * g.z};
  }
  const double pressure = lame.lambda_mpa * (strain.xx + strain.yy + strain.zz);
  return lame.mu_mpa * Stress{2 * strain.xx, 2 * strain.yy, 2 * strain.zz, strain.xy, strain.yz, strain.zx} +
         Stress{pressure, pressure, pressure, 0, 0, 0};
}

}  // namespace

double largest_principal_mpa(const Stress& s) {
  // Eigenvalues of a symmetric 3x3 matrix: mean + 2 r cos(angle + 2 pi k / 3) (Smith 1961).
  const double mean = (s.xx + s.yy + s.zz) / 3;
  const double x = s.xx - mean, y = s.yy - mean, z = s.zz - mean;
  const double r = std::sqrt((x * x + y * y + z * z + 2 * (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx)) / 6);
  if (!(r > 0)) return std::abs(mean);
  const double half_det =
      (x * (y * z - s.yz * s.yz) - s.xy * (s.xy * z - s.yz * s.zx) + s.zx * (s.xy * s.yz - y * s.zx)) / 2;
  const double angle = std::acos(std::clamp(half_det / (r * r * r), -1.0, 1.0)) / 3;
  const double most = mean + 2 * r * std::cos(angle);
  const double least = mean + 2 * r * std::cos(angle + 2 * std::numbers::pi / 3);
  return std::max(most, -least);
}

NodalField elastic_forces_n(const QuadraticTets& mesh, const ElasticMaterial& material, const NodalField& moved_mm) {
  assert(moved_mm.size() == mesh.nodes.size());
  const Lame lame(material);
  NodalField forces(mesh.nodes.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const TetShape shape = tet_shape(mesh, t);
    for (const auto& place : detail::tet_points) {
      const auto gradients = shape_gradients(shape, place);
      const Stress s = shape.volume_mm3 / 4 * stress_of(lame, mesh.tets[t], moved_mm, gradients);
      for (std::size_t n = 0; n < 10; ++n) {
        const Vec3 g = gradients[n];
        forces[mesh.tets[t][n]] += {s.xx * g.x + s.xy * g.y + s.zx * g.z, s.xy * g.x + s.yy * g.y + s.yz * g.z,
                                    s.zx * g.x + s.yz * g.y + s.zz * g.z};
      }
    }
  }
  return forces;
}

Stress stress_in(const QuadraticTets& mesh, const ElasticMaterial& material, const NodalField& moved_mm,
                 std::size_t tet, const std::array<double, 4>& place) {
  return stress_of(Lame(material), mesh.tets[tet], moved_mm, shape_gradients(tet_shape(mesh, tet), place));
}

}  // namespace aplomb
