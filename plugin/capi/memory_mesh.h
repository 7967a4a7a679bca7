#pragma once

#include "aplomb.h"
#include "aplomb/core/error.h"
#include "aplomb/io/read_mesh.h"

namespace aplomb::capi {

/// A mesh in a host's memory as if it came from a file. One that shares no vertex is indexed as an STL is.
///
/// \return invalid_option for a mesh that breaks the rules of aplomb.h; unusable_input for one without triangles, an
///         index out of range (naming the triangle) or a coordinate beyond float32; over_budget.
Result<MeshFile> read_memory(const aplomb_mesh* mesh, const ReadOptions& options);

}  // namespace aplomb::capi
