#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// A place of a void in which liquid stays: a lowest point, and how high it may rise before it runs off to a lower one.
struct Dip {
  Vec3 bottom_mm;
  double pass_mm =
      std::numeric_limits<double>::infinity();  ///< height at which it runs over; the lowest dip never does
};

struct Dips {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  std::vector<Dip> dips;                 ///< lowest first
  std::vector<std::uint32_t> of_vertex;  ///< the dip that a vertex lies in, below its pass; else none
};

/// The dips of a void that are deeper than that, and its lowest: the merge tree of the heights of its surface. (Every
/// change in how a body's part below a plane hangs together happens at a critical point of its surface.)
///
/// \pre One closed surface, wound outward from the void. \par Cost  O(n log n).
Dips dips_of(const TriangleMesh& surface, double least_depth_mm);

}  // namespace aplomb::detail
