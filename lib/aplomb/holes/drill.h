#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/holes/hole.h"
#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {

/// A mesh with holes in it.
struct Drilled {
  TriangleMesh mesh;                ///< bounds a solid
  std::size_t untouched = 0;        ///< the first triangles: the given mesh's own, in their order
  std::size_t untouched_outer = 0;  ///< of these, those that were among its first outer_triangles
  std::vector<Hole> holes;          ///< as they were drilled: the prism of one may be turned
};

/// Cuts the prisms of the holes out of a solid (CGAL's corefinement, in a child process). What the prisms do not cut
/// stays as it was, to the bit; the rest is rounded to float32 and checked. Where the result is no solid the prisms are
/// turned about their axes and it is tried again.
///
/// \pre  The prisms do not meet. \param outer_triangles  how many of the mesh's first triangles are outside.
/// \return cancelled, third_party with what was wrong with the result.
/// \par Cost  about 1 s for 100k triangles, twice that with the check.
Result<Drilled> drill(const TriangleMesh& solid, std::size_t outer_triangles, std::span<const Hole> holes,
                      const Job& job = {});

/// A closed solid that fills a hole with clearance_mm of play all round: its outer end is the outside as it came, its
/// inner end is flat, where the hole's axis leaves the void.
///
/// \param outer  the solid's outside before it was drilled.
/// \return as drill().
Result<std::vector<TriangleMesh>> plugs(const TriangleMesh& outer, std::span<const Hole> holes,
                                        double clearance_mm = 0.15, const Job& job = {});

}  // namespace aplomb
