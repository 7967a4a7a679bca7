#pragma once

#include <vector>

#include "aplomb/adapters/cholmod/sparse_cholesky.h"
#include "aplomb/deform/deform_cage.h"
#include "aplomb/deform/detail/soft_terms.h"
#include "aplomb/deform/detail/tet_energy.h"
#include "aplomb/deform/detail/tet_shape.h"

namespace aplomb::detail {

/// The unknowns: three for each vertex that is not fixed.
class FreeVertices {
 public:
  explicit FreeVertices(const std::vector<bool>& fixed);

  int unknowns() const { return unknowns_; }
  /// The first of the vertex's three unknowns; -1 when it is fixed.
  int first_unknown(std::size_t vertex) const { return first_[vertex]; }
  std::vector<double> gather(const std::vector<Vec3>& field) const;
  /// Zero at fixed vertices. \pre values holds unknowns() numbers.
  std::vector<Vec3> scatter(const double* values) const;

 private:
  std::vector<int> first_;
  int unknowns_ = 0;
};

/// Everything that a change of shape costs (mm3), as a function of the cage's vertices:
///
///     E(v) = sum_T V_T f_T w_T W(F_T S_T^-1)  +  ground  +  handles,     S_T the wanted F
class CageEnergy {
 public:
  CageEnergy(const CageProblem& problem, const DeformOptions& options, const std::vector<TetShape>& shapes);

  /// Infinity when a tetrahedron is inverted.
  double value(const std::vector<Vec3>& vertices) const;
  std::vector<Vec3> gradient(const std::vector<Vec3>& vertices) const;
  /// The gradient of the quadratic model: that of value(), but for what is foreseen to press against the ground.
  std::vector<Vec3> model_gradient(const std::vector<Vec3>& vertices) const;

  /// The Hessian by the free vertices. With `projected`, every tetrahedron's share is made positive semidefinite by
  /// leaving out its negative modes, and 1e-6 of the weight holds each vertex where it is, so that the sum is definite.
  /// The reference holds until the next call.
  const adapters::SparseSymmetric& hessian(const std::vector<Vec3>& vertices, bool projected = true);

  /// Foresees which vertices a step presses against the ground, in addition, for model_gradient() and hessian(). True:
  /// something new, and the step is worth another try.
  bool foresee(const std::vector<Vec3>& now, const std::vector<Vec3>& next);
  void forget();

  const FreeVertices& free() const { return free_; }

 private:
  void make_pattern();
  std::vector<Vec3> elastic_gradient(const std::vector<Vec3>& vertices) const;
  void drop_fixed(std::vector<Vec3>& field) const;
  void add_tet(std::size_t t, const std::vector<Vec3>& vertices, bool projected);
  void add_block(const TetMesh::Tet& corners, std::size_t k, std::size_t l, int offset, const Mat3& block);
  int block_offset(int row_vertex, int column_vertex) const;

  const CageProblem& problem_;
  std::vector<TetShape> shapes_;  // their slopes make F S^-1
  TetEnergy density_;
  FreeVertices free_;
  std::vector<double> weights_;  // V_T f_T w_T
  std::vector<double> holds_;    // of each vertex, mm
  std::vector<Ground> grounds_;
  std::vector<HandleTerm> handles_;
  adapters::SparseSymmetric hessian_;
  std::vector<std::array<int, 10>> offsets_;  // of each tet's blocks (k, l), l <= k, within their columns; -1: fixed
  std::vector<std::vector<int>> neighbours_;  // free vertices after the one at hand, ascending, by unknown / 3
};

}  // namespace aplomb::detail
