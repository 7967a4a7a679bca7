#pragma once

#include <optional>
#include <vector>

#include "aplomb/adapters/cgal/surface_repair.h"
#include "aplomb/core/error.h"
#include "aplomb/core/isolated.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/triangle_mesh.h"

/// CGAL's repairs, each in a child process of its own, where a crash, a hang or megabytes of warnings harm nobody.
/// \return what run_isolated() says; nothing in the optional when CGAL found no answer.
namespace aplomb::detail {

Result<adapters::ClosedSurface> closed_surface(const TriangleMesh& soup, const IsolationLimits& limits, const Job& job);
Result<std::optional<TriangleMesh>> united(const std::vector<TriangleMesh>& bodies, const IsolationLimits& limits,
                                           const Job& job);
Result<std::optional<TriangleMesh>> without_self_intersections(const TriangleMesh& mesh, const IsolationLimits& limits,
                                                               const Job& job);

}  // namespace aplomb::detail
