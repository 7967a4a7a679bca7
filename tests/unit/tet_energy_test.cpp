#include "aplomb/deform/detail/tet_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/derivatives.h"
#include "support/shapes.h"

namespace aplomb::detail {
namespace {

Mat3 sum(const Mat3& a, double s, const Mat3& b) {
  return {{{a.rows[0] + s * b.rows[0], a.rows[1] + s * b.rows[1], a.rows[2] + s * b.rows[2]}}};
}
double inner(const Mat3& a, const Mat3& b) {
  return dot(a.rows[0], b.rows[0]) + dot(a.rows[1], b.rows[1]) + dot(a.rows[2], b.rows[2]);
}
Mat3 diagonal(double x, double y, double z) { return {{{{x, 0, 0}, {0, y, 0}, {0, 0, z}}}}; }
Mat3 turn(double angle_rad) { return test::rotation({1, 2, -0.5}, angle_rad).linear; }

Mat3 random_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-1, 1);
  Mat3 m;
  for (Vec3& row : m.rows) row = {entry(random), entry(random), entry(random)};
  return m;
}

/// At rest, with two and three equal stretches, squeezed, swollen, turned by more than half a turn, and sheared.
std::vector<Mat3> shapes() {
  return {Mat3{},
          diagonal(2, 2, 0.5),
          diagonal(1.5, 1.5, 1.5),
          turn(2.5) * diagonal(0.4, 1, 1.7),
          turn(0.7) * diagonal(0.3, 0.4, 0.6) * turn(-1.2),
          Mat3{{{{1, 0.8, -0.3}, {0.1, 0.9, 0.4}, {-0.2, 0.3, 1.2}}}}};
}

TEST(TetEnergy, IsLeastAtRestWhereItIsZero) {
  const TetEnergy energy;
  EXPECT_NEAR(energy.value(Mat3{}), 0, 1e-15);
  EXPECT_NEAR(inner(energy.gradient(Mat3{}), energy.gradient(Mat3{})), 0, 1e-24);
  for (const auto& mode : energy.modes(Mat3{})) EXPECT_GE(mode.curvature, energy.beta * (1 - 1e-12));
}

TEST(TetEnergy, GradientAgreesWithCentralDifferences) {
  std::mt19937 random(1);
  for (const Mat3& f : shapes())
    for (int i = 0; i < 4; ++i) {
      const TetEnergy energy;
      const Mat3 direction = random_matrix(random);
      test::expect_derivative([&](double s) { return energy.value(sum(f, 0.3 * s, direction)); },
                              0.3 * inner(energy.gradient(f), direction), 10);
    }
}

TEST(TetEnergy, HessianAgreesWithCentralDifferencesOfTheGradient) {
  std::mt19937 random(2);
  for (const Mat3& f : shapes())
    for (int i = 0; i < 4; ++i) {
      const TetEnergy energy;
      const Mat3 a = random_matrix(random), b = random_matrix(random);
      double second = 0;
      for (const auto& mode : energy.modes(f))
        second += mode.curvature * inner(mode.direction, a) * inner(mode.direction, b);
      test::expect_derivative([&](double s) { return inner(energy.gradient(sum(f, 0.1 * s, a)), b); }, 0.1 * second,
                              10);
    }
}

TEST(TetEnergy, ModesAreOrthonormal) {
  for (const Mat3& f : shapes()) {
    const auto modes = TetEnergy{}.modes(f);
    for (std::size_t i = 0; i < modes.size(); ++i)
      for (std::size_t k = 0; k <= i; ++k)
        EXPECT_NEAR(inner(modes[i].direction, modes[k].direction), i == k ? 1 : 0, 1e-12);
  }
}

TEST(TetEnergy, WithoutThePoseTermIsBlindToTurning) {
  const TetEnergy energy{.alpha = 0.2, .beta = 0, .gamma = 10};
  for (const Mat3& f : shapes())
    EXPECT_NEAR(energy.value(turn(1.1) * f), energy.value(f), 1e-12 * (1 + energy.value(f)));
}

TEST(TetEnergy, ATurnCostsThePoseTermAlone) {
  const TetEnergy energy{.beta = 3};
  for (const double angle : {0.1, 1.0, 3.0})
    EXPECT_NEAR(energy.value(turn(angle)), 3 * 2 * (1 - std::cos(angle)), 1e-12);
}

TEST(TetEnergy, IsInfiniteForAnInvertedOrFlatTetrahedron) {
  EXPECT_TRUE(std::isinf(TetEnergy{}.value(diagonal(1, 1, -1))));
  EXPECT_TRUE(std::isinf(TetEnergy{}.value(diagonal(1, 1, 0))));
  EXPECT_GT(TetEnergy{}.value(diagonal(1, 1, 1e-6)), 1e10);
}

}  // namespace
}  // namespace aplomb::detail
