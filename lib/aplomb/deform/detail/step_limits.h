#pragma once

#include <vector>

#include "aplomb/deform/detail/tet_shape.h"

namespace aplomb::detail {

/// The largest s <= 1 such that no tetrahedron inverts on the way from `vertices` to vertices + s step, s itself
/// excluded (it may be flat there). \pre No tetrahedron is inverted in `vertices`.
double step_without_inversion(const TetMesh& mesh, const std::vector<TetShape>& shapes,
                              const std::vector<Vec3>& vertices, const std::vector<Vec3>& step);

/// The smallest root in (0, 1] of  c0 + c1 s + c2 s^2 + c3 s^3,  from below to 1e-12; 1 when there is none.
/// \pre c0 > 0.
double smallest_root(double c0, double c1, double c2, double c3);

}  // namespace aplomb::detail
