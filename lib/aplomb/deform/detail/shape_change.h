#pragma once

#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/deform/detail/tet_shape.h"

namespace aplomb::detail {

/// The mean displacement of the tetrahedra's centroids, weighted; convex in the vertices. \pre Weights have a sum > 0.
double mean_displacement_mm(const TetMesh& rest, const std::vector<double>& weights, const std::vector<Vec3>& vertices);

double max_displacement_mm(const TetMesh& rest, const std::vector<Vec3>& vertices);

/// The angle of the rotation of F's polar decomposition. \pre det F > 0.
double turn_rad(const Mat3& f);

/// The largest turn of a tetrahedron. \pre None is inverted.
double max_turn_rad(const TetMesh& rest, const std::vector<TetShape>& shapes, const std::vector<Vec3>& vertices);

/// The change of the weighted volume, as a share of it.
double volume_change_ratio(const TetMesh& rest, const std::vector<TetShape>& shapes, const std::vector<double>& weights,
                           const std::vector<Vec3>& vertices);

}  // namespace aplomb::detail
