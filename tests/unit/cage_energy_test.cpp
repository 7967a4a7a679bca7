#include "aplomb/deform/detail/cage_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "aplomb/mesh/placement.h"
#include "support/derivatives.h"
#include "support/tet_boxes.h"

namespace aplomb::detail {
namespace {

using Field = std::vector<Vec3>;

double inner(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += dot(a[v], b[v]);
  return sum;
}
Field moved(Field field, double s, const Field& by) {
  for (std::size_t v = 0; v < field.size(); ++v) field[v] += s * by[v];
  return field;
}
Field noise(const CageProblem& problem, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  Field field(problem.rest.vertices.size());
  for (std::size_t v = 0; v < field.size(); ++v)
    if (!problem.fixed[v]) field[v] = {entry(random), entry(random), entry(random)};
  return field;
}

/// A small bar with a plate that its upper half is under, a handle, unequal weights and a wanted shape: every term
/// counts.
struct Everything {
  CageProblem problem = test::leaning_bar(10, 0.1, 2);
  DeformOptions options{.ground_ratio = 3};
  std::vector<TetShape> shapes;
  Field position;

  Everything() {
    problem.handles.push_back({problem.samples.back().at, {3, 4, 70}, 0.1});
    problem.stiffness[5] = 7;
    problem.wanted.assign(problem.rest.tets.size(), {});
    problem.wanted[2] = {{{{1.1, 0.2, 0}, {-0.1, 0.9, 0.1}, {0, 0.3, 1.2}}}};
    problem.solid_share[3] = 0.1;
    shapes = tet_shapes(problem.rest);
    position = moved(problem.rest.vertices, 1, noise(problem, 3));
    for (Vec3& v : position) v.z *= v.z > 20 ? 0.9 : 1;
    problem.grounds = {{{0, 0, 1}, 45}};
  }
};

/// a^T H b for the stored lower triangle.
double quadratic(const adapters::SparseSymmetric& h, const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (int c = 0; c < h.size(); ++c)
    for (int i = h.column_starts[c]; i < h.column_starts[c + 1]; ++i) {
      const int r = h.rows[i];
      sum += h.values[i] * (a[r] * b[c] + (r != c ? a[c] * b[r] : 0));
    }
  return sum;
}

TEST(CageEnergy, IsZeroAtRest) {
  CageProblem problem = test::leaning_bar(10, 0.1, 2);
  const auto shapes = tet_shapes(problem.rest);
  const CageEnergy energy(problem, {}, shapes);
  EXPECT_NEAR(energy.value(problem.rest.vertices), 0, 1e-9);
  for (const Vec3& g : energy.gradient(problem.rest.vertices)) EXPECT_NEAR(norm(g), 0, 1e-9);
}

TEST(CageEnergy, IsZeroWhereEveryTetrahedronHasItsWantedShape) {
  CageProblem problem = test::leaning_bar(10, 0.1, 2);
  problem.fixed.assign(problem.fixed.size(), false);
  problem.grounds.clear();
  const Affine3 wanted = {1.3 * rotation_of({{1, 2, 3}, 0.7}), {}};
  problem.wanted.assign(problem.rest.tets.size(), wanted.linear);
  const auto shapes = tet_shapes(problem.rest);
  const CageEnergy energy(problem, {}, shapes);
  Field there = problem.rest.vertices;
  for (Vec3& v : there) v = wanted * v + Vec3{5, 6, 7};
  EXPECT_NEAR(energy.value(there), 0, 1e-9);
  EXPECT_GT(energy.value(problem.rest.vertices), 100);
}

TEST(CageEnergy, GradientAgreesWithCentralDifferences) {
  const Everything all;
  const CageEnergy energy(all.problem, all.options, all.shapes);
  const Field gradient = energy.gradient(all.position);
  for (unsigned seed = 10; seed < 14; ++seed) {
    const Field direction = noise(all.problem, seed);
    test::expect_derivative([&](double s) { return energy.value(moved(all.position, s, direction)); },
                            inner(gradient, direction), 1e4, 1e-7);
  }
}

TEST(CageEnergy, HessianAgreesWithCentralDifferencesOfTheGradient) {
  const Everything all;
  CageEnergy energy(all.problem, all.options, all.shapes);
  const auto hessian = energy.hessian(all.position, false);
  for (unsigned seed = 20; seed < 24; ++seed) {
    const Field a = noise(all.problem, seed), b = noise(all.problem, seed + 100);
    test::expect_derivative([&](double s) { return inner(energy.gradient(moved(all.position, 0.1 * s, a)), b); },
                            0.1 * quadratic(hessian, energy.free().gather(a), energy.free().gather(b)), 1e3, 1e-7);
  }
}

TEST(CageEnergy, ProjectedHessianIsPositiveDefiniteWhereTheTrueOneIsNot) {
  Everything all;
  for (Vec3& v : all.position) v = {1.5 * v.x, 1.5 * v.y, 0.3 * v.z};  // squeezed: it would buckle
  CageEnergy energy(all.problem, {.beta_ratio = 0}, all.shapes);
  auto factors = adapters::SparseCholesky::analyse(energy.hessian(all.position));
  ASSERT_TRUE(factors.has_value());
  EXPECT_FALSE(factors->factorise(energy.hessian(all.position, false)));
  EXPECT_TRUE(factors->factorise(energy.hessian(all.position)));
}

TEST(CageEnergy, GroundLeavesAloneWhatWasBelowThePlateAndNoLower) {
  CageProblem problem = test::leaning_bar(0, 0.1, 2);
  problem.grounds = {{{0, 0, 1}, 25}};
  const auto shapes = tet_shapes(problem.rest);
  const CageEnergy energy(problem, {}, shapes);
  EXPECT_NEAR(energy.value(problem.rest.vertices), 0, 1e-9);
}

}  // namespace
}  // namespace aplomb::detail
