#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "aplomb/core/pulse.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// A point of a surface that stands for the area round it.
struct SurfaceSample {
  Vec3 point_mm;
  std::uint32_t triangle = 0;
  double area_mm2 = 0;
};

/// Every triangle cut into cells of about spacing x spacing (strips across its longest side), a sample in the middle of
/// each; of triangles smaller than that, one for every quarter of a cell's area. The areas add up to the mesh's.
/// The spacing is widened until there are about `at_most`, and returned with them. Where the pulse stopped, not all.
///
/// \pre No triangle is degenerate. \par Cost  O(triangles + samples).
struct SurfaceSamples {
  std::vector<SurfaceSample> samples;
  double spacing_mm = 0;
};
SurfaceSamples sample_surface(const TriangleMesh& mesh, double spacing_mm, std::size_t at_most,
                              const Pulse& pulse = {});

/// The numbers of points that hang together when those within `reach_mm` are joined: each group ascending, groups in
/// the order of their first points. No groups where the pulse stopped. \par Cost  O(points) while
/// few are much nearer together than the reach.
std::vector<std::vector<std::uint32_t>> groups_within(const std::vector<Vec3>& points, double reach_mm,
                                                      const Pulse& pulse = {});

}  // namespace aplomb::detail
