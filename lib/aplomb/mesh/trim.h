#pragma once

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {

/// Cuts off what lies below the plane z = height_mm and closes the solid with one flat face. Every triangle above the
/// plane stays as it was, to the bit; of those that it cuts the upper part stays, and its points on the plane
/// are rounded to float32 in x and y. The plane may be lowered by up to 0.001 mm, so as to pass through no vertex.
///
/// \return unusable_input when nothing or everything lies below, or the cut cannot be closed without touching itself;
///         cancelled.
/// \par Cost  check_solid()'s, and O(n).
Result<SolidMesh> trim_base(const SolidMesh& solid, double height_mm, const Job& job = {});

}  // namespace aplomb
