#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "aplomb/core/vec.h"

namespace aplomb {

/// Tetrahedra with shared vertices, positively oriented: dot(b - a, cross(c - a, d - a)) > 0.
struct TetMesh {
  using Tet = std::array<std::uint32_t, 4>;
  std::vector<Vec3> vertices;
  std::vector<Tet> tets;
};

/// Signed volume of a tetrahedron (mm3).
constexpr double signed_volume(Vec3 a, Vec3 b, Vec3 c, Vec3 d) { return dot(b - a, cross(c - a, d - a)) / 6; }

}  // namespace aplomb
