#include "aplomb/mesh/detail/topology.h"

namespace aplomb::detail {
namespace {

constexpr Corner corners_a_step = 32;  // about a microsecond

template <class Visit>
void for_each_directed_edge(const TriangleMesh& mesh, const Pulse& pulse, Visit&& visit) {
  for (Corner c = 0; c < 3 * mesh.triangles.size(); ++c) {
    if (c % corners_a_step == 0 && !pulse.goes_on()) return;
    const std::uint32_t a = vertex_at(mesh, c), b = vertex_at(mesh, next_corner(c));
    if (a != b) visit(std::min(a, b), std::max(a, b), c);
  }
}

}  // namespace

EdgeTable::EdgeTable(const TriangleMesh& mesh, const Pulse& pulse) : starts_(mesh.vertices.size() + 1) {
  for_each_directed_edge(mesh, pulse, [&](std::uint32_t low, std::uint32_t, Corner) { ++starts_[low + 1]; });
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  struct Use {
    std::uint32_t high;
    Corner corner;
    bool operator<(const Use& b) const { return std::pair(high, corner) < std::pair(b.high, b.corner); }
  };
  std::vector<Use> uses(starts_.back());
  std::vector<std::size_t> ends(starts_.begin(), starts_.end() - 1);
  for_each_directed_edge(mesh, pulse, [&](std::uint32_t low, std::uint32_t high, Corner c) {
    uses[ends[low]++] = {high, c};
  });
  highs_.resize(uses.size());
  corners_.resize(uses.size());
  for (std::size_t low = 0; low + 1 < starts_.size() && pulse.goes_on(); ++low) {
    std::sort(uses.begin() + static_cast<std::ptrdiff_t>(starts_[low]),
              uses.begin() + static_cast<std::ptrdiff_t>(starts_[low + 1]));
    for (std::size_t i = starts_[low]; i < starts_[low + 1]; ++i) {
      highs_[i] = uses[i].high;
      corners_[i] = uses[i].corner;
    }
  }
}

Components edge_components(const TriangleMesh& mesh, const EdgeTable& edges, const Pulse& pulse) {
  DisjointSets sets(mesh.triangles.size());
  const auto join = [&](std::uint32_t, std::uint32_t, std::span<const Corner> corners) {
    for (const Corner c : corners.subspan(1)) sets.join(corners[0] / 3, c / 3);
  };
  edges.for_each(join, pulse);
  Components components{std::vector<std::uint32_t>(mesh.triangles.size()), 0};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % corners_a_step == 0 && !pulse.goes_on()) break;
    const std::uint32_t root = sets.find(t);
    components.of_triangle[t] = root == t ? components.count++ : components.of_triangle[root];
  }
  return components;
}

}  // namespace aplomb::detail
