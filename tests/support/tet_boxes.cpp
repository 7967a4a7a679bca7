#include "support/tet_boxes.h"

#include <algorithm>
#include <cmath>

#include "support/shapes.h"

namespace aplomb::test {

TetMesh tet_box(Vec3 min, Vec3 max, CellCount cells) {
  TetMesh mesh;
  const Vec3 size = max - min;
  for (int z = 0; z <= cells.z; ++z)
    for (int y = 0; y <= cells.y; ++y)
      for (int x = 0; x <= cells.x; ++x)
        mesh.vertices.push_back(min + Vec3{size.x * x / cells.x, size.y * y / cells.y, size.z * z / cells.z});
  const auto index = [&](std::array<int, 3> at) {
    return std::uint32_t((at[2] * (cells.y + 1) + at[1]) * (cells.x + 1) + at[0]);
  };
  for (int z = 0; z < cells.z; ++z)
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x) {
        std::array<std::size_t, 3> axes{0, 1, 2};
        do {  // from corner to corner along the axes in every order
          std::array<int, 3> at{x, y, z};
          TetMesh::Tet tet{index(at)};
          for (std::size_t k = 0; k < 3; ++k) ++at[axes[k]], tet[k + 1] = index(at);
          const auto& v = mesh.vertices;
          if (signed_volume(v[tet[0]], v[tet[1]], v[tet[2]], v[tet[3]]) < 0) std::swap(tet[1], tet[2]);
          mesh.tets.push_back(tet);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
  return mesh;
}

std::vector<SolidSample> samples_of(const TetMesh& mesh, const std::function<double(Vec3)>& carvable) {
  const double near = (5 + 3 * std::sqrt(5.0)) / 20, far = (1 - near) / 3;
  std::vector<SolidSample> samples;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tets[t];
    const auto& v = mesh.vertices;
    const double volume = signed_volume(v[a], v[b], v[c], v[d]);
    for (std::size_t k = 0; k < 4; ++k) {
      EmbeddedPoint at{std::uint32_t(t), {far, far, far, far}};
      at.weights[k] = near;
      samples.push_back({at, volume / 4, carvable(at.position(mesh, v))});
    }
  }
  return samples;
}

BalanceProblem standing_on(const std::vector<Vec2>& polygon) {
  BalanceProblem problem;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], edge = polygon[(i + 1) % polygon.size()] - p;
    const Vec3 inward = Vec3{-edge.y, edge.x, 0} / norm(edge);
    problem.rows.push_back({{-dot(inward, {p.x, p.y, 0}), inward}, {0, {0, 0, 1}}});
  }
  return problem;
}

CageProblem leaning_bar(double lean_mm, double required_tip_rad, int cells) {
  CageProblem problem;
  const double height = 60, half = 10, wall = 3;
  problem.rest = tet_box({-half, -half, 0}, {half, half, height}, {cells, cells, 3 * cells});
  const auto deep = [&](Vec3 p) {
    return std::max(std::abs(p.x), std::abs(p.y)) < half - wall && p.z > wall && p.z < height - wall ? 1.0 : 0.0;
  };
  problem.samples = samples_of(problem.rest, deep);
  for (Vec3& v : problem.rest.vertices) {
    problem.fixed.push_back(v.z == 0);
    v.x += lean_mm * v.z / height;  // a shear keeps every volume
  }
  problem.solid_share.assign(problem.rest.tets.size(), 1);
  problem.stiffness.assign(problem.rest.tets.size(), 1);
  problem.balance = standing_on({{-half, -half}, {half, -half}, {half, half}, {-half, half}});
  problem.required_t = std::tan(required_tip_rad);
  problem.grounds = {{}};
  return problem;
}

CageProblem turned_about_z(CageProblem problem, double angle_rad) {
  const Affine3 turn = rotation({0, 0, 1}, angle_rad);
  for (Vec3& v : problem.rest.vertices) v = turn * v;
  for (BalanceRow& row : problem.balance.rows)
    for (AffineForm* form : {&row.a, &row.b}) form->gradient = turn * form->gradient;
  for (SoftHandle& handle : problem.handles) handle.target_mm = turn * handle.target_mm;
  return problem;
}

VolumeRange volume_range(const TetMesh& rest, const std::vector<Vec3>& vertices) {
  VolumeRange range{1e300, -1e300};
  for (const auto& [a, b, c, d] : rest.tets) {
    const auto volume = [&](const std::vector<Vec3>& v) { return signed_volume(v[a], v[b], v[c], v[d]); };
    const double change = volume(vertices) / volume(rest.vertices);
    range.least = std::min(range.least, change);
    range.most = std::max(range.most, change);
  }
  return range;
}

}  // namespace aplomb::test
