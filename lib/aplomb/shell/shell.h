#pragma once

#include <cstddef>

#include "aplomb/carve/void_field.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {

struct ShellOptions {
  double wall_mm = 2;              ///< what the shell must keep, > 0; the void was carved for it
  double deviation_voxels = 0.04;  ///< how far simplifying may move the inner surface, in [0, 1]; 0 does not simplify
};

/// A sentence that names field, value and range; empty when there is nothing to say.
std::string find_problem(const ShellOptions& options);

/// What is printed: the outer surface as it came, and the surfaces of the voids, reversed, in one mesh.
struct Shell {
  TriangleMesh mesh;
  std::size_t outer_triangles = 0;  ///< the first ones; the rest are voids'
  std::size_t voids = 0;            ///< carved here
  double wall_mm = 0;               ///< least distance from a carved void to the outer surface; infinity without one
  double loose_mm3 = 0;             ///< crumbs of material that floated in the void and were taken out
};

/// Meshes the void by marching tetrahedra and joins it to the solid's own triangles.
///
/// The wall holds by construction: on a tetrahedron d(x)^2 >= sum l_i d_i^2 - R^2 >= W^2 - 3/4 voxel^2 (d^2 - |x|^2 is
/// concave). It is measured again on the simplified surface, rounded to float32; where that does not keep it, the
/// surface is simplified less, at last not at all.
///
/// \pre  find_problem(options) is empty; `field` was cut from a volume of this solid with this wall.
/// \post Closed, 2-manifold, no self-intersection; shell.wall_mm >= options.wall_mm; the first triangles and vertices
///       are the solid's own, in their order.
/// \return cancelled; internal when the wall does not hold.
/// \par Cost  about 1 s of CPU for 340k triangles before they are simplified.
Result<Shell> build_shell(const SolidMesh& solid, const VoidField& field, const ShellOptions& options,
                          const Job& job = {});

}  // namespace aplomb
