#pragma once

#include <functional>

namespace aplomb::test {

/// Expects that `slope` is f'(0): the error of the central difference must fall with the square of the step over three
/// scales, until rounding (a share `rounding` of |slope| + scale) stops it.
void expect_derivative(const std::function<double(double)>& f, double slope, double scale, double rounding = 1e-8);

}  // namespace aplomb::test
