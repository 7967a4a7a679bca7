#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/detail/triangle_tree.h"
#include "aplomb/mesh/print_numbers.h"

namespace aplomb::detail {

/// A component that encloses another one, and how often it winds round it: +1 when it is wound outward.
struct Enclosure {
  std::uint32_t component = 0;
  int winding = 0;
};

/// The components of a mesh as bodies: which touch, and which lie in which.
///
/// \pre  Coordinates are float32 values; `mesh` and `components` outlive this.
/// \par Cost  Near-linear for components whose boxes lie apart, and for any number that are joined; the product of
/// their
///       numbers where boxes overlap and bodies are not. At most 500 steps a triangle and 50 million more (2 s) are
///       allowed; a report every few milliseconds.
/// \return cancelled; unusable_input with the remedy where more steps would be needed.
class Nesting {
 public:
  /// Where the pulse stopped, of no use.
  Nesting(const TriangleMesh& mesh, const EdgeTable& edges, const Components& components, const Pulse& pulse = {});

  /// Sets of components that cross or touch, in a chain; degenerate triangles cross nothing.
  Result<DisjointSets> touching(const Job& job);

  /// Sets of components of which one touches, crosses or encloses the next.
  Result<DisjointSets> connected(const Job& job);

  /// What encloses the first vertex of each component, ascending. \pre Every component is closed and touches no other
  /// one; else the answer is that of a ray straight up.
  Result<std::vector<std::vector<Enclosure>>> enclosures(const Job& job);

  /// How often all that encloses a component winds round it, in sum; and sets of components of which one encloses the
  /// next.
  struct Windings {
    std::vector<int> sums;
    DisjointSets sets;
  };
  Result<Windings> windings(const Job& job);

 private:
  class Effort;
  class Lumps;

  std::uint32_t count() const { return static_cast<std::uint32_t>(boxes_.size()); }
  std::span<const std::uint32_t> triangles_of(std::uint32_t component) const {
    return {triangles_.data() + starts_[component], triangles_.data() + starts_[component + 1]};
  }
  template <class Meets, class Visit>
  void for_each_triangle(std::uint32_t component, Effort& effort, Meets&& meets, Visit&& visit);
  bool meet(std::uint32_t a, std::uint32_t b, Effort& effort);
  int winding(std::uint32_t component, Vec3 p, Effort& effort);
  template <class Enter, class Visit>
  Result<void> for_each_enclosure(const Job& job, Enter&& enter, Visit&& visit);
  template <class AreOne>
  Result<void> join_pairs(DisjointSets& sets, const Job& job, AreOne&& are_one);
  Result<void> join_enclosed(DisjointSets& sets, const Job& job);
  Vec3 place_of(std::uint32_t component) const {
    return mesh_.vertices[mesh_.triangles[triangles_of(component)[0]][0]];
  }
  Effort effort(const Job& job) const;

  const TriangleMesh& mesh_;
  std::vector<std::size_t> starts_;              // of each component in triangles_
  std::vector<std::uint32_t> triangles_;         // by component
  std::vector<FloatBox> boxes_;                  // of components
  std::vector<FloatBox> columns_;                // where a ray up can wind round: from -infinity if it is open
  std::vector<std::unique_ptr<BoxTree>> trees_;  // of a large component's triangles, made when asked for
};

/// Each set of components as one print.
PrintNumbers numbered(Components components, DisjointSets& sets);

}  // namespace aplomb::detail
