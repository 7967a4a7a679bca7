#pragma once

#include <array>

#include "aplomb/core/vec.h"

namespace aplomb::detail {

/// How much a change of shape costs, per volume at rest, as a function of the deformation gradient F:
///
///     W(F) = alpha psi(F) + beta/2 |F - I|^2 + gamma/2 (det F - 1)^2,   psi(F) = (|F|^2 + |F^-1|^2) / 2 - 3
///
/// psi, the symmetric Dirichlet energy, is infinite where det F <= 0: it keeps every tetrahedron the right way out.
/// beta is what turning costs, gamma what a change of volume costs. W(I) = 0 is the minimum.
struct TetEnergy {
  double alpha = 0.2;
  double beta = 1;
  double gamma = 10;

  /// W(F); infinity where det F <= 0.
  double value(const Mat3& f) const;

  /// dW / dF. \pre det F > 0.
  Mat3 gradient(const Mat3& f) const;

  struct Mode {
    double curvature = 0;
    Mat3 direction;  ///< of unit Frobenius norm, orthogonal to the others
  };
  /// The eigenvalues and eigenmatrices of d2W / dF2, exact (Smith, De Goes and Kim 2019, "Analytic Eigensystems for
  /// Isotropic Distortion Energies"; the volume term is isotropic too, and beta adds to every eigenvalue).
  /// Negative ones belong to the Hessian: who wants it positive semidefinite leaves them out. \pre det F > 0.
  std::array<Mode, 9> modes(const Mat3& f) const;
};

/// det F times the transposed inverse of F: the derivative of det F.
constexpr Mat3 cofactor(const Mat3& f) {
  const auto& r = f.rows;
  return {{{cross(r[1], r[2]), cross(r[2], r[0]), cross(r[0], r[1])}}};
}

}  // namespace aplomb::detail
