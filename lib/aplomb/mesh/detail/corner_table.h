#pragma once

#include <cstdint>
#include <vector>

#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::detail {

/// The connectivity of a closed 2-manifold (Rossignac 2001): corner c is also the half-edge from its vertex to that of
/// next_corner(c). Edges may be collapsed; triangles and vertices keep their numbers.
class CornerTable {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  /// \pre The mesh is closed, consistently wound and 2-manifold.
  /// Where the pulse stopped, of no use.
  explicit CornerTable(const TriangleMesh& mesh, const Pulse& pulse = {});

  std::uint32_t vertex(Corner c) const { return vertices_[c]; }
  std::uint32_t head(Corner c) const { return vertices_[next_corner(c)]; }
  /// The corner before c at the same triangle.
  static constexpr Corner previous(Corner c) { return c % 3 == 0 ? c + 2 : c - 1; }
  /// The same edge the other way.
  Corner twin(Corner c) const { return twins_[c]; }
  /// The next half-edge that leaves the same vertex, counter-clockwise.
  Corner turned(Corner c) const { return twins_[previous(c)]; }
  /// A half-edge that leaves the vertex; `none` for a vertex without triangles.
  Corner leaving(std::uint32_t v) const { return leaving_[v]; }
  std::uint32_t valence(std::uint32_t v) const { return valences_[v]; }
  bool has_triangle(std::uint32_t t) const { return vertices_[3 * std::size_t{t}] != none; }

  /// Whether collapsing the half-edge leaves a 2-manifold of the same genus with no valence under 3: the two ends
  /// share two neighbours (the link condition, Dey et al. 1999), and these have a valence of 4 or more.
  bool may_collapse(Corner c);

  /// Moves vertex(c) into head(c); two triangles vanish. \pre may_collapse(c).
  void collapse(Corner c);

 private:
  void glue(Corner a, Corner b) {
    twins_[a] = b;
    twins_[b] = a;
  }

  std::vector<std::uint32_t> vertices_, twins_;    // by corner
  std::vector<std::uint32_t> leaving_, valences_;  // by vertex
  std::vector<std::uint32_t> marks_;               // by vertex: the last question that marked it
  std::uint32_t question_ = 0;
};

}  // namespace aplomb::detail
