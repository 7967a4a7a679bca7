#pragma once

#include <vector>

#include "aplomb/deform/cage.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// How the points of a surface follow a cage: Phong deformation (James 2020),
///
///     x' = 1/2 sum_k w_k v'_k  +  1/2 sum_k w_k (v'_k + F_k (x - v_k))
///
/// with F_k the mean deformation gradient of the tetrahedra at cage vertex k, by solid volume. Linear interpolation
/// alone shows the tetrahedra as creases. Where all four vertices of a tetrahedron stay, so do its points, exactly.
class SurfaceMotion {
 public:
  /// \return internal when the cage does not hold a vertex.
  static Result<SurfaceMotion> make(const Cage& cage, const TriangleMesh& surface);

  /// The surface when the cage's vertices are at `moved_mm`, rounded to float32; triangles and order of vertices as
  /// given.
  TriangleMesh moved(const std::vector<Vec3>& moved_mm) const;

 private:
  TetMesh rest_;
  std::vector<double> solid_share_;
  TriangleMesh surface_;
  std::vector<EmbeddedPoint> points_;
};

}  // namespace aplomb
