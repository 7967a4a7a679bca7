#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/core/vec.h"
#include "aplomb/mesh/tet_mesh.h"

namespace aplomb {

/// Tetrahedra with a node at every corner and one in the middle of every edge, which is straight: corners 0 to 3, then
/// the edges 01, 02, 03, 12, 13, 23. Displacements are quadratic in each, so that it can bend; linear tetrahedra lock.
struct QuadraticTets {
  using Tet = std::array<std::uint32_t, 10>;
  std::vector<Vec3> nodes;  ///< the corners first
  std::vector<Tet> tets;
};
QuadraticTets quadratic_tets(const TetMesh& mesh);

/// Isotropic. Stresses that given forces cause do not depend on young_mpa.
struct ElasticMaterial {
  double young_mpa = 2000;
  double poisson_ratio = 0.35;  ///< in [0, 0.49]
};

/// A symmetric tensor.
struct Stress {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;  ///< MPa
};
constexpr Stress operator+(const Stress& a, const Stress& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.zx + b.zx};
}
constexpr Stress operator*(double s, const Stress& a) {
  return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.yz, s * a.zx};
}

/// The largest compression or tension in any direction: the principal stress of the largest magnitude, without sign.
double largest_principal_mpa(const Stress& stress);

/// A vector at every node.
using NodalField = std::vector<Vec3>;

/// The forces at the nodes that hold a displaced body in balance, K u: those of the stresses in it.
NodalField elastic_forces_n(const QuadraticTets& mesh, const ElasticMaterial& material, const NodalField& moved_mm);

/// The stress in a tetrahedron; affine in the place, given by its barycentric coordinates.
Stress stress_in(const QuadraticTets& mesh, const ElasticMaterial& material, const NodalField& moved_mm,
                 std::size_t tet, const std::array<double, 4>& place);

/// What holds a body, and the forces on it.
struct ElasticLoads {
  std::vector<bool> held;              ///< by node
  NodalField held_at_mm{};             ///< displacement of the nodes held; empty: none
  std::vector<NodalField> forces_n{};  ///< one load case each
};

/// Displacements under small strain, a field for each load case: K u = f, linear elasticity with ten-node tetrahedra
/// (Zienkiewicz and Taylor; four points integrate K exactly), factorised once by CHOLMOD.
///
/// \pre  Each connected part of the mesh has three held nodes or more that are not collinear.
/// \post Deterministic.
/// \return over_budget before the factors are allocated, when they would take more than memory_bytes; third_party;
///         cancelled.
/// \par Cost  lib/README.md, "Strength by elasticity".
Result<std::vector<NodalField>> solve_elasticity(const QuadraticTets& mesh, const ElasticMaterial& material,
                                                 const ElasticLoads& loads, std::size_t memory_bytes,
                                                 const Job& job = {});

}  // namespace aplomb
