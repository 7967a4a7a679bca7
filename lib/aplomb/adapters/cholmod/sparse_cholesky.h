#pragma once

#include <memory>
#include <vector>

#include "aplomb/core/error.h"

namespace aplomb::adapters {

/// The lower triangle of a symmetric matrix, column by column, rows ascending within a column.
struct SparseSymmetric {
  std::vector<int> column_starts{0};  ///< one more than there are columns
  std::vector<int> rows;
  std::vector<double> values;

  int size() const { return int(column_starts.size()) - 1; }
};

/// Cholesky factors of matrices that share one pattern, by CHOLMOD (Chen, Davis, Hager, Rajamanickam 2008).
/// The pattern is ordered and analysed once; each factorisation reuses that.
class SparseCholesky {
 public:
  /// \pre matrix.size() > 0. \return third_party.
  static Result<SparseCholesky> analyse(const SparseSymmetric& matrix);

  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;
  ~SparseCholesky();

  /// What the factors will take: 8 bytes a number that is not 0. Known before factorise() allocates it.
  double factor_bytes() const;

  /// False: the matrix is not positive definite (or memory ran out), and there are no factors to solve with.
  /// \pre `matrix` has the analysed pattern.
  bool factorise(const SparseSymmetric& matrix);

  /// Solves for `columns` right-hand sides, one after the other in `right`.
  /// \pre The last factorise() gave true.
  std::vector<double> solve(const std::vector<double>& right, int columns = 1) const;

 private:
  struct Impl;
  explicit SparseCholesky(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace aplomb::adapters
