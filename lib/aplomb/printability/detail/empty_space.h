#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/volume/voxel_frame.h"

namespace aplomb::detail {

/// The empty space outside a printed solid and what opens to the outside; closed voids count as solid.
class EmptySpace {
 public:
  static constexpr std::uint32_t no_hint = adapters::SurfaceDistance::no_triangle;

  explicit EmptySpace(const PrintedSolid& printed);

  struct Clearance {
    double mm = 0;          ///< radius of the largest ball round the point in the empty space; 0 outside that
    double surface_mm = 0;  ///< distance to the nearest surface, whatever side
    std::uint32_t triangle = no_hint;
  };
  Clearance at(Vec3 point_mm, std::uint32_t hint) const;
  Vec3 closest_point(Vec3 point_mm, std::uint32_t triangle) const {
    return distance_.closest_point(point_mm, triangle);
  }
  const TriangleMesh& surface() const { return surface_; }
  const Box3& box() const { return box_; }

 private:
  TriangleMesh surface_;  // the outer shells, then the voids
  std::uint32_t first_void_triangle_;
  Box3 box_;
  adapters::SurfaceDistance distance_;
};

/// Clearances on a lattice round the solid, in blocks of 8^3 points; what has `wide_mm` or more all over is kept as
/// one.
///
/// \post Two neighbours (of 26) whose clearances add up to the distance between them are joined by a straight line in
///       empty space. Every point that is not in a block of its own is either blocked or in a wide one.
class ClearanceLattice {
 public:
  static constexpr int side = 8;
  static constexpr std::uint32_t points = side * side * side;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// \return cancelled; over_budget when more than `most_blocks` would be held.
  static Result<ClearanceLattice> sample(const EmptySpace& space, double spacing_mm, double wide_mm,
                                         std::size_t most_blocks, const Job& job);

  const VoxelFrame& frame() const { return frame_; }
  double wide_mm() const { return wide_mm_; }
  /// Elements: every point of a held block, then every wide block.
  std::uint32_t elements() const { return static_cast<std::uint32_t>(held_.size() * points + wide_.size()); }
  std::uint32_t held_points() const { return static_cast<std::uint32_t>(held_.size() * points); }
  bool is_wide_block(std::uint32_t element) const { return element >= held_points(); }
  /// The element a point belongs to; none where blocked or outside the lattice.
  std::uint32_t element(const VoxelIndex& index) const;
  float clearance_mm(std::uint32_t element) const {
    return is_wide_block(element) ? wide_[element - held_points()].clearance_mm
                                  : held_[element / points].values[element % points];
  }
  /// Of a point, or the middle of a wide block.
  VoxelIndex index(std::uint32_t element) const;

 private:
  struct Held {
    std::uint32_t block = 0;
    std::array<float, points> values{};  // x slowest
  };
  struct Wide {
    std::uint32_t block = 0;
    float clearance_mm = 0;
  };
  struct Sampler;

  VoxelIndex origin_of(std::uint32_t block) const;

  VoxelFrame frame_;
  double wide_mm_ = 0;
  std::array<int, 3> size_{};          // in blocks
  std::vector<std::uint32_t> number_;  // per block: of its first element, or none
  std::vector<Held> held_;
  std::vector<Wide> wide_;
};

}  // namespace aplomb::detail
