#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/print_numbers.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// Tells what would be printed apart: groups of surface components that touch, cross or lie inside one another (a void
/// belongs to the solid around it). Components are joined across edges between equal places, whether or not the mesh
/// numbers those as one vertex.
///
/// \return cancelled; unusable_input where too many components lie in one another's boxes without meeting.
/// \par Cost  O(n log n), whatever the number of components that lie apart, cross or are nested; 0.1 s for 100k
/// triangles.
Result<PrintNumbers> number_prints(const TriangleMesh& mesh, const Job& job = {});

/// Takes a mesh apart into its prints.
///
/// \post The triangles of all parts together are those of the mesh, each part keeping its triangles' order. A mesh in
/// one
///       piece comes back as it was.
/// \return as number_prints().
Result<std::vector<TriangleMesh>> split_prints(const TriangleMesh& mesh, const Job& job = {});

}  // namespace aplomb
