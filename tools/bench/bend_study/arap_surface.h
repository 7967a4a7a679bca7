#pragma once

#include <optional>
#include <vector>

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::bench {

struct ArapOptions {
  double spacing_mm = 0;      ///< > 0: no vertex is farther from the nearest one that the cage carries
  double alpha_ratio = 0.02;  ///< CGAL's default: how much neighbouring rotations must agree
  int iterations = 4;         ///< >= 1
};

/// Smooth as-rigid-as-possible deformation (SRE-ARAP: Levi and Gotsman 2015; CGAL's Surface_mesh_deformation with its
/// default SparseLU): held vertices and a farthest-point sample of the others go where `guess` has them, the rest
/// follow. The first rotations are those of `guess`.
///
/// \pre rest is 2-manifold; guess has its triangles.
/// \return nothing where CGAL could not factorise its system.
std::optional<TriangleMesh> arap_surface(const TriangleMesh& rest, const TriangleMesh& guess,
                                         const std::vector<bool>& held, const ArapOptions& options);

}  // namespace aplomb::bench
