#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "aplomb/printability/elasticity.h"
#include "aplomb/printability/finding.h"

namespace aplomb::detail {

/// Stresses by weight and by pushes along x and y.
using LoadStress = std::array<Stress, 3>;

/// With the push in this direction.
Stress pushed_towards(const LoadStress& stress, double azimuth_rad);

/// Of sixteen directions of the push: at most 2 % below the worst of all.
double worst_push_mpa(const LoadStress& stress);

/// At the four corners of every tetrahedron. \pre Three fields.
std::vector<std::array<LoadStress, 4>> corner_stresses(const QuadraticTets& mesh, const ElasticMaterial& material,
                                                       const std::vector<NodalField>& moved_mm);

/// The stress that volume_mm3 of what counts exceeds, in the worst direction of the push: its place is the centroid of
/// that volume, its box all of it. Nothing where less counts.
///
/// \param counts  whether a point of a tetrahedron does.
std::vector<Place> exceeded_stress(const QuadraticTets& mesh, const std::vector<std::array<LoadStress, 4>>& stresses,
                                   const std::function<bool(std::size_t tet, Vec3 at_mm)>& counts, double volume_mm3);

}  // namespace aplomb::detail
