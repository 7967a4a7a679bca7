#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "aplomb/deform/detail/balance_step.h"
#include "aplomb/deform/detail/carved_samples.h"
#include "aplomb/deform/detail/shape_change.h"
#include "aplomb/deform/detail/step_limits.h"
#include "support/derivatives.h"
#include "support/shapes.h"
#include "support/tet_boxes.h"

namespace aplomb::detail {
namespace {

using Field = std::vector<Vec3>;

Field noise(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  Field field(size);
  for (Vec3& v : field) v = {entry(random), entry(random), entry(random)};
  return field;
}
Field moved(Field field, double s, const Field& by) {
  for (std::size_t v = 0; v < field.size(); ++v) field[v] += s * by[v];
  return field;
}
double inner(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += dot(a[v], b[v]);
  return sum;
}

struct Bar {
  CageProblem problem = test::leaning_bar(25, 0.1, 3);
  std::vector<TetShape> shapes = tet_shapes(problem.rest);
  Field position = moved(problem.rest.vertices, 0.5, noise(problem.rest.vertices.size(), 1));
};

TEST(HeldCarving, MomentGradientsAgreeWithCentralDifferences) {
  Bar bar;
  CarvedSamples samples(bar.problem, bar.shapes);
  const auto kept = samples.best_carving(bar.position)->shares;
  const Vec3 origin{1, 2, 3};
  const auto slopes = moment_gradients(bar.problem.rest, bar.shapes, kept, bar.position, origin);
  const Field direction = noise(bar.position.size(), 2);
  for (std::size_t m = 0; m < 4; ++m)
    test::expect_derivative(
        [&](double s) {
          const Moments at =
              held_moments(bar.problem.rest, bar.shapes, kept, moved(bar.position, s, direction), origin);
          return m == 0 ? at.volume_mm3 : at.first_mm4[int(m) - 1];
        },
        inner(slopes[m], direction), 1e4);
}

TEST(HeldCarving, OfEverythingAtRestHasTheMomentsOfTheBar) {
  Bar bar;
  for (SolidSample& sample : bar.problem.samples) sample.carvable = 0;
  CarvedSamples samples(bar.problem, bar.shapes);
  const auto kept = samples.best_carving(bar.problem.rest.vertices)->shares;
  const Moments body = held_moments(bar.problem.rest, bar.shapes, kept, bar.problem.rest.vertices, {});
  EXPECT_NEAR(body.volume_mm3, 24000, 1e-8);
  EXPECT_NEAR(norm(body.centroid_mm() - Vec3{12.5, 0, 30}), 0, 1e-11);
}

TEST(CarvedSamples, BestTHasTheDerivativeOfTheHeldCarving) {
  Bar bar;
  bar.problem.balance.rows = {bar.problem.balance.rows[1]};  // of one edge, so that t is smooth: the envelope theorem
  CarvedSamples samples(bar.problem, bar.shapes);
  const auto best = samples.best_carving(bar.position);
  ASSERT_TRUE(best.has_value());
  const auto slopes = moment_gradients(bar.problem.rest, bar.shapes, best->shares, bar.position, samples.origin());
  const Moments body = held_moments(bar.problem.rest, bar.shapes, best->shares, bar.position, samples.origin());
  const BalanceRow& row = samples.rows().rows[0];
  EXPECT_NEAR(best->t, row.a(body) / row.b(body), 1e-9);
  const AffineForm form = row.at(best->t);
  for (unsigned seed = 5; seed < 8; ++seed) {
    const Field d = noise(bar.position.size(), seed);
    const double slope = form.constant * inner(slopes[0], d) + form.gradient.x * inner(slopes[1], d) +
                         form.gradient.y * inner(slopes[2], d) + form.gradient.z * inner(slopes[3], d);
    test::expect_derivative([&](double s) { return samples.best_carving(moved(bar.position, s, d))->t; },
                            slope / row.b(body), 0.01, 1e-3);
  }
}

TEST(CarvedSamples, CarvingRaisesTAndNeverBeyondWhatTheSolidCouldDo) {
  Bar bar;
  CarvedSamples carved(bar.problem, bar.shapes);
  const double with = carved.best_carving(bar.position)->t;
  for (SolidSample& sample : bar.problem.samples) sample.carvable = 0;
  CarvedSamples solid(bar.problem, bar.shapes);
  EXPECT_GT(with, solid.best_carving(bar.position)->t + 0.01);
}

TEST(RowForces, MeetTheConditionsOfTheLeastEnergy) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    BalanceProblem rows;
    for (int i = 0; i < 9; ++i) rows.rows.push_back({{normal(random), {normal(random), normal(random), 1}}, {1, {}}});
    MomentResponse response;
    double root[4][4];
    for (auto& r : root)
      for (double& value : r) value = normal(random);
    for (std::size_t i = 0; i < 4; ++i) {
      response.unbalanced[i] = normal(random);
      for (std::size_t k = 0; k < 4; ++k) {
        response.softness[i][k] = 0;
        for (int m = 0; m < 4; ++m) response.softness[i][k] += root[i][m] * root[k][m];
      }
    }
    const RowForces forces = row_forces(rows, 0, {1, {}}, response);
    Moments4 after = response.unbalanced;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) after[i] += response.softness[i][k] * forces.on_moments[k];
    double work = 0;  // of the multipliers on the slacks: zero, for a row that pushes is met exactly
    for (std::size_t i = 0; i < 4; ++i) work += after[i] * forces.on_moments[i];
    EXPECT_NEAR(work, 0, 1e-7 * (1 + forces.price));
    EXPECT_GE(forces.price, 0);
    for (const BalanceRow& row : rows.rows)
      EXPECT_GE(row.a(Moments{after[0], {after[1], after[2], after[3]}}), -1e-8 * (1 + forces.price));
  }
}

TEST(StepLimits, SmallestRootIsTheFirstOfThree) {
  const auto root = [](double a, double b, double c) {  // (1 - s/a)(1 - s/b)(1 - s/c)
    return smallest_root(1, -1 / a - 1 / b - 1 / c, 1 / (a * b) + 1 / (b * c) + 1 / (a * c), -1 / (a * b * c));
  };
  EXPECT_NEAR(root(0.3, 0.5, 0.9), 0.3, 1e-11);
  EXPECT_NEAR(root(-0.3, 0.5, 7), 0.5, 1e-11);
  EXPECT_NEAR(root(0.31, 0.312, -2), 0.31, 1e-11);
  EXPECT_EQ(root(-1, 2, 3), 1);
  EXPECT_NEAR(smallest_root(1, -4, 0, 0), 0.25, 1e-11);
}

TEST(StepLimits, StopWhereTheFirstTetrahedronIsFlat) {
  const TetMesh box = test::tet_box({0, 0, 0}, {1, 1, 1}, {});
  Field step(box.vertices.size());
  for (std::size_t v = 0; v < step.size(); ++v) step[v].z = -4 * box.vertices[v].z;
  EXPECT_NEAR(step_without_inversion(box, tet_shapes(box), box.vertices, step), 0.25, 1e-11);
}

TEST(ShapeChange, OfATurnedAndSwollenBoxFollowsTheClosedForms) {
  const TetMesh box = test::tet_box({-1, -1, -1}, {1, 1, 1}, {2, 2, 2});
  const auto shapes = tet_shapes(box);
  for (const double angle : {1e-9, 0.3, 3.1}) {
    Field vertices = box.vertices;
    for (Vec3& v : vertices) v = test::rotation({1, 1, 3}, angle) * (1.1 * v);
    EXPECT_NEAR(max_turn_rad(box, shapes, vertices), angle, 1e-12);
    EXPECT_NEAR(volume_change_ratio(box, shapes, std::vector<double>(shapes.size(), 2.0), vertices), 0.331, 1e-12);
  }
  EXPECT_NEAR(mean_displacement_mm(box, std::vector<double>(shapes.size(), 2.0),
                                   moved(box.vertices, 3, Field(box.vertices.size(), {0, 0.6, 0.8}))),
              3, 1e-12);
}

}  // namespace
}  // namespace aplomb::detail
