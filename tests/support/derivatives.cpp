#include "support/derivatives.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aplomb::test {

void expect_derivative(const std::function<double(double)>& f, double slope, double scale, double rounding) {
  const auto error = [&](double h) { return std::abs((f(h) - f(-h)) / (2 * h) - slope); };
  const double floor = rounding * (std::abs(slope) + scale);
  double coarser = error(1e-2);
  EXPECT_LT(coarser, 0.05 * (std::abs(slope) + scale));
  for (const double h : {1e-3, 1e-4}) {
    const double finer = error(h);
    EXPECT_LE(finer, coarser / 30 + floor) << "step " << h << ", slope " << slope;
    coarser = finer;
  }
}

}  // namespace aplomb::test
