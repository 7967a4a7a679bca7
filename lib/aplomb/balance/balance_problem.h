#pragma once

#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/mesh/mass_properties.h"

namespace aplomb {

/// x -> constant + gradient . x, a function on model space that integrates over a body by its moments alone.
struct AffineForm {
  double constant = 0;
  Vec3 gradient;

  double operator()(Vec3 point) const { return constant + dot(gradient, point); }
  /// The integral of the form over the body.
  double operator()(const Moments& body) const { return constant * body.volume_mm3 + dot(gradient, body.first_mm4); }
};

constexpr AffineForm operator+(const AffineForm& f, const AffineForm& g) {
  return {f.constant + g.constant, f.gradient + g.gradient};
}
constexpr AffineForm operator-(const AffineForm& f, const AffineForm& g) {
  return {f.constant - g.constant, f.gradient - g.gradient};
}
constexpr AffineForm operator*(double s, const AffineForm& f) { return {s * f.constant, s * f.gradient}; }

/// One condition of one pose, affine in x, with the scalar t that all conditions share:
///
///     g(body, t) = integral over the body of ( a(x) - t b(x) ) >= 0
///
/// Standing: a row per edge of the support polygon, a = inward distance from the edge's vertical plane, b =
/// height above the plate, t = tan(tip angle). See DESIGN of the poses in lib/README.md.
struct BalanceRow {
  AffineForm a;
  AffineForm b;

  AffineForm at(double t) const { return a - t * b; }
};

/// The rows of every pose that must hold at once.
struct BalanceProblem {
  std::vector<BalanceRow> rows;
};

/// The largest t for which every row holds for this body: min over rows of a(body) / b(body); rows with
/// b(body) = 0 hold or do not hold whatever t is, and give -infinity where they do not.
///
/// \pre problem.rows is not empty; b(body) >= 0 for every row.
double largest_t(const BalanceProblem& problem, const Moments& body);

}  // namespace aplomb
