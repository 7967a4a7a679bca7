#include "aplomb/adapters/cholmod/sparse_cholesky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace aplomb::adapters {
namespace {

using Dense = std::vector<std::vector<double>>;

/// A random symmetric matrix, about a third of it zeros, made definite by its diagonal.
Dense definite_matrix(std::size_t n) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> entry(-1, 1);
  Dense a(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) a[i][k] = a[k][i] = (i * 7 + k * 3) % 3 ? entry(random) : 0;
    a[i][i] = double(n);
  }
  return a;
}

SparseSymmetric sparse(const Dense& a) {
  SparseSymmetric s;
  for (std::size_t c = 0; c < a.size(); ++c) {
    for (std::size_t r = c; r < a.size(); ++r)
      if (a[r][c] != 0) s.rows.push_back(int(r)), s.values.push_back(a[r][c]);
    s.column_starts.push_back(int(s.rows.size()));
  }
  return s;
}

/// By elimination without pivots: the matrix is diagonally dominant.
std::vector<double> dense_solve(Dense a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t p = 0; p < n; ++p)
    for (std::size_t r = p + 1; r < n; ++r) {
      const double f = a[r][p] / a[p][p];
      for (std::size_t c = p; c < n; ++c) a[r][c] -= f * a[p][c];
      b[r] -= f * b[p];
    }
  for (std::size_t p = n; p-- > 0;) {
    for (std::size_t c = p + 1; c < n; ++c) b[p] -= a[p][c] * b[c];
    b[p] /= a[p][p];
  }
  return b;
}

TEST(SparseCholesky, SolvesWhatADenseSolveDoes) {
  const std::size_t n = 40;
  const Dense a = definite_matrix(n);
  auto factors = SparseCholesky::analyse(sparse(a));
  ASSERT_TRUE(factors.has_value());
  ASSERT_TRUE(factors->factorise(sparse(a)));
  std::vector<double> b, both;
  for (std::size_t i = 0; i < n; ++i) b.push_back(std::sin(double(i)));
  both = b;
  for (const double value : b) both.push_back(2 * value);
  const std::vector<double> expected = dense_solve(a, b), x = factors->solve(both, 2);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(x[i], expected[i], 1e-13);
    EXPECT_NEAR(x[n + i], 2 * expected[i], 1e-13);
  }
}

TEST(SparseCholesky, FactorisesAgainWithOtherNumbersAndRefusesIndefiniteOnes) {
  const Dense a = definite_matrix(12);
  auto factors = SparseCholesky::analyse(sparse(a));
  ASSERT_TRUE(factors.has_value());
  SparseSymmetric other = sparse(a);
  other.values.back() = -1;
  EXPECT_FALSE(factors->factorise(other));
  for (double& value : other.values) value = 0;
  for (std::size_t c = 0; c < 12; ++c) other.values[std::size_t(other.column_starts[c])] = 2;
  EXPECT_TRUE(factors->factorise(other));
  for (const double x : factors->solve(std::vector<double>(12, 3.0))) EXPECT_NEAR(x, 1.5, 1e-15);
}

}  // namespace
}  // namespace aplomb::adapters
