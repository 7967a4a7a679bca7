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

  /// The surface moved so that it does not cross itself, or as moved() has it where that cannot be had. Sheets that lie
  /// on one another, as scans have them, may cross when bent by ever so little: round every crossing the surface moves
  /// by one affine map, which keeps apart what was apart, within 1 % of the height, then 2, 4 and 8 %; the map fades
  /// out to twice as far. Vertices that are `held` stay.
  ///
  /// \return cancelled.
  Result<TriangleMesh> moved_apart(const std::vector<Vec3>& moved_mm, const std::vector<bool>& held,
                                   const Job& job = {}) const;

 private:
  Vec3 moved_point(std::size_t n, const std::vector<Vec3>& moved_mm, const std::vector<Mat3>& gradients) const;
  Mat3 gradient_at(std::size_t n, const std::vector<Mat3>& gradients) const;

  TetMesh rest_;
  std::vector<double> solid_share_;
  TriangleMesh surface_;
  std::vector<EmbeddedPoint> points_;
};

}  // namespace aplomb
