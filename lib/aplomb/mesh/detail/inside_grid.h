#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// Which nodes of a lattice lie inside a surface, however broken: those round which it winds a positive number of
/// times (3MF's positive fill rule), by a vote of six rays along the axes. For a closed surface all six agree.
/// After Nooruddin and Turk 2003, with winding numbers for their parities.
class InsideGrid {
 public:
  /// \pre  mesh has a box of positive diagonal; voxels_on_diagonal >= 8.
  /// \post A rim of at least one node all round is outside.
  /// \return cancelled; unusable_input where 2000 triangles' boxes lie over a ray, on average.
  /// \par Cost  O(nodes + rays that the triangles' boxes cover); 0.1 s for 100k triangles and 200 voxels. Memory that
  /// does
  ///       not grow with the triangles.
  static Result<InsideGrid> sampled(const TriangleMesh& mesh, const Box3& box, int voxels_on_diagonal,
                                    const Job& job = {});

  double voxel_mm() const { return voxel_mm_; }
  Vec3 origin_mm() const { return origin_mm_; }
  const std::array<int, 3>& size() const { return size_; }
  /// A node's number, and where it stands.
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(i);
  }
  Vec3 place_mm(std::size_t index) const;
  bool inside(int i, int j, int k) const { return inside_[index(i, j, k)]; }
  double volume_mm3() const;
  /// The share of the inside nodes on which the six rays did not agree.
  double doubtful_ratio() const { return doubtful_ratio_; }
  /// Of the nodes that are inside in exactly one of the two. \pre The same box and number of voxels.
  double difference_mm3(const InsideGrid& other) const;

 private:
  InsideGrid() = default;
  Result<void> vote_along(int axis, const TriangleMesh& mesh, std::vector<std::uint8_t>& votes, const Job& job) const;
  void vote_on_ray(int axis, int x, int y, const std::int32_t* turns, std::vector<std::uint8_t>& votes) const;

  double voxel_mm_ = 0;
  Vec3 origin_mm_;
  std::array<int, 3> size_{};
  std::vector<bool> inside_;
  double doubtful_ratio_ = 0;
};

/// Whether a candidate fills the same space as the mesh it was made of, within 1 % and two voxels of its box.
/// \return as InsideGrid::sampled().
Result<bool> fill_alike(const TriangleMesh& mesh, const TriangleMesh& candidate, int voxels_on_diagonal,
                        const Job& job = {});

/// The surface of the inside of a grid: closed, manifold and free of self-intersections, within about a voxel of
/// `mesh` where that was whole. Marching tetrahedra over the distances to `mesh`, signed by the grid.
TriangleMesh surface_of(const InsideGrid& grid, const TriangleMesh& mesh);

}  // namespace aplomb::detail
