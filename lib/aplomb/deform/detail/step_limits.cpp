#include "aplomb/deform/detail/step_limits.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "aplomb/deform/detail/tet_energy.h"

namespace aplomb::detail {
namespace {

double contraction(const Mat3& a, const Mat3& b) {
  return dot(a.rows[0], b.rows[0]) + dot(a.rows[1], b.rows[1]) + dot(a.rows[2], b.rows[2]);
}

}  // namespace

double smallest_root(double c0, double c1, double c2, double c3) {
  assert(c0 > 0);
  if (c0 + std::min(c1, 0.0) + std::min(c2, 0.0) + std::min(c3, 0.0) > 0) return 1;  // the usual case
  const auto value = [&](double s) { return c0 + s * (c1 + s * (c2 + s * c3)); };
  double turns[2] = {1, 1};  // where the slope vanishes, ascending
  if (const double disc = c2 * c2 - 3 * c1 * c3; disc > 0) {
    const double q = -(c2 + std::copysign(std::sqrt(disc), c2));
    turns[0] = 3 * c3 != 0 ? q / (3 * c3) : 1;
    turns[1] = q != 0 ? c1 / q : 1;
    std::sort(turns, turns + 2);
  }
  double low = 0;
  for (double high : {turns[0], turns[1], 1.0}) {
    high = std::clamp(high, 0.0, 1.0);
    if (high <= low) continue;
    if (value(high) > 0) {
      low = high;
      continue;
    }
    while (high - low > 1e-12) {
      const double middle = (low + high) / 2;
      (value(middle) > 0 ? low : high) = middle;
    }
    return low;
  }
  return 1;
}

double step_without_inversion(const TetMesh& mesh, const std::vector<TetShape>& shapes,
                              const std::vector<Vec3>& vertices, const std::vector<Vec3>& step) {
  double least = 1;
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    const Mat3 f = deformation_gradient(shapes[t], mesh.tets[t], vertices);
    const Mat3 d = deformation_gradient(shapes[t], mesh.tets[t], step);
    const double root =
        smallest_root(determinant(f), contraction(cofactor(f), d), contraction(f, cofactor(d)), determinant(d));
    least = std::min(least, root);
  }
  return least;
}

}  // namespace aplomb::detail
