#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "aplomb/core/vec.h"

namespace aplomb {

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed triangle mesh in millimetres, as it came: nothing is promised but that indices are in range and
/// coordinates are finite. A SolidMesh promises more.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;

  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

Box3 bounding_box(const TriangleMesh& mesh);

/// The same mesh with every coordinate rounded to the nearest float32, which is what STL holds and slicers read.
TriangleMesh rounded_to_float(TriangleMesh mesh);

/// `first` followed by `second`, indices shifted.
TriangleMesh joined(TriangleMesh first, const TriangleMesh& second);

/// The same surface seen from the other side: every triangle's winding reversed.
TriangleMesh reversed(TriangleMesh mesh);

/// The same mesh moved; a mirroring transform (negative determinant) is re-wound so that outside stays outside.
TriangleMesh transformed(TriangleMesh mesh, const Affine3& transform);

}  // namespace aplomb
