#pragma once

#include <cstddef>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

struct OrientedShells {
  TriangleMesh mesh;
  std::size_t turned = 0;   ///< shells that were inside out
  std::size_t dropped = 0;  ///< shells that change nothing: bodies inside a solid, voids outside one
};

/// Winds closed shells so that they bound a solid: the outermost outward, with all that is nested in them turned
/// along; then leaves out what positive fill (a point is solid when it is wound round at least once) does not see.
/// Shells that cross others are wound outward, unless they lie in the box of another one, and never left out.
///
/// \pre Every component is closed, manifold and consistently wound.
/// \return as Nesting.
Result<OrientedShells> oriented_shells(const TriangleMesh& mesh, const Job& job = {});

/// The components as bodies to unite: 2 to 64, all wound outward; else nothing.
std::vector<TriangleMesh> bodies_to_unite(const TriangleMesh& mesh);

/// Shells that are wound outward. \pre As for oriented_shells().
std::size_t count_bodies(const TriangleMesh& mesh);

/// Shells of less than a thousandth of the volume, which cutting and voxels leave behind, taken out.
TriangleMesh without_crumbs(const TriangleMesh& mesh);

}  // namespace aplomb::detail
