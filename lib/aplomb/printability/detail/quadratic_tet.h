#pragma once

#include <array>

#include "aplomb/printability/elasticity.h"

/// The ten-node tetrahedron: L_i are the barycentric coordinates, N_i = L_i (2 L_i - 1) at corners, 4 L_i L_j between.
namespace aplomb::detail {

inline constexpr std::array<std::array<std::size_t, 2>, 6> tet_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Four points of equal weight that integrate quadratic functions exactly.
inline constexpr std::array<std::array<double, 4>, 4> tet_points = [] {
  constexpr double far = 0.13819660112501052, near = 1 - 3 * far;  // (5 - sqrt 5) / 20
  return std::array<std::array<double, 4>, 4>{
      {{near, far, far, far}, {far, near, far, far}, {far, far, near, far}, {far, far, far, near}}};
}();

struct TetShape {
  std::array<Vec3, 4> gradients;  ///< of L_i
  double volume_mm3 = 0;
};
TetShape tet_shape(const QuadraticTets& mesh, std::size_t tet);

/// Of the ten shape functions.
std::array<Vec3, 10> shape_gradients(const TetShape& shape, const std::array<double, 4>& place);

/// Lame's constants.
struct Lame {
  double lambda_mpa = 0, mu_mpa = 0;
  explicit Lame(const ElasticMaterial& m)
      : lambda_mpa(m.young_mpa * m.poisson_ratio / ((1 + m.poisson_ratio) * (1 - 2 * m.poisson_ratio))),
        mu_mpa(m.young_mpa / (2 * (1 + m.poisson_ratio))) {}
};

}  // namespace aplomb::detail
