#include "aplomb/mesh/detail/soup.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <compare>

#include "aplomb/adapters/cgal/exact_predicates.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/detail/triangle_tree.h"

namespace aplomb::detail {
namespace {

using Place = std::array<float, 3>;

Place place_of(Vec3 v) {  // + 0 makes a zero of -0
  return {static_cast<float>(v.x) + 0.0F, static_cast<float>(v.y) + 0.0F, static_cast<float>(v.z) + 0.0F};
}

/// The corners' places of a triangle, the least first.
using Placed = std::array<Place, 3>;

std::vector<Placed> placed(const TriangleMesh& mesh) {
  std::vector<Placed> list;
  list.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    Placed corners{place_of(mesh.vertices[t[0]]), place_of(mesh.vertices[t[1]]), place_of(mesh.vertices[t[2]])};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    list.push_back(corners);
  }
  return list;
}

struct PlaceHash {
  std::size_t operator()(const Place& p) const {
    std::size_t hash = 0;
    for (const float c : p) hash = (hash ^ std::hash<float>()(c)) * 0x9E3779B97F4A7C15ULL + (hash >> 31);
    return hash;
  }
};

bool is_degenerate(const TriangleMesh& mesh, const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ||
         adapters::are_collinear(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
}

/// +1 when t runs through its sorted corners in an even order.
int winding(const Triangle& t) { return ((t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0])) == 2 ? 1 : -1; }

std::vector<std::size_t> uses_of_corners(const TriangleMesh& mesh) {
  std::vector<std::size_t> uses(3 * mesh.triangles.size());
  EdgeTable(mesh).for_each([&](std::uint32_t, std::uint32_t, std::span<const Corner> corners) {
    for (const Corner c : corners) uses[c] = corners.size();
  });
  return uses;
}

/// Closer than this is the same place: 4 ulp of the largest coordinate.
double nearness(const TriangleMesh& mesh) {
  const Box3 box = bounding_box(mesh);
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return std::ldexp(largest, -21);
}

/// The ends of edges that do not have two triangles, ascending.
std::vector<std::uint32_t> faulty_vertices(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faulty;
  EdgeTable(mesh).for_each([&](std::uint32_t low, std::uint32_t high, std::span<const Corner> corners) {
    if (corners.size() != 2) faulty.insert(faulty.end(), {low, high});
  });
  std::sort(faulty.begin(), faulty.end());
  faulty.erase(std::unique(faulty.begin(), faulty.end()), faulty.end());
  return faulty;
}

template <class Visit>
void for_each_box_near(const TriangleTree& tree, Vec3 p, double near, Visit&& visit) {
  const auto meets = [&](const FloatBox& b) {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < b.min[axis] - near || p[axis] > b.max[axis] + near) return false;
    return true;
  };
  tree.for_each(meets, visit);
}

/// Makes one of the ends of edges too short to be, and of faulty vertices too near to be two.
std::size_t merge_near_vertices(TriangleMesh& mesh) {
  const double near = nearness(mesh);
  DisjointSets places(mesh.vertices.size());
  const auto are_near = [&](std::uint32_t a, std::uint32_t b) {
    return norm(mesh.vertices[a] - mesh.vertices[b]) <= near;
  };
  for (Corner c = 0; c < 3 * mesh.triangles.size(); ++c)
    if (const std::uint32_t a = vertex_at(mesh, c), b = vertex_at(mesh, next_corner(c)); are_near(a, b))
      places.join(a, b);
  const std::vector<std::uint32_t> faulty = faulty_vertices(mesh);
  if (!faulty.empty()) {
    TriangleMesh points{mesh.vertices, {}};
    for (const std::uint32_t v : faulty) points.triangles.push_back({v, v, v});
    const TriangleTree tree(points);
    for (const std::uint32_t v : faulty)
      for_each_box_near(tree, mesh.vertices[v], near, [&](std::uint32_t other) {
        if (are_near(v, faulty[other])) places.join(v, faulty[other]);
      });
  }
  std::size_t merged = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) merged += places.find(v) != v;
  for (Triangle& t : mesh.triangles) t = {places.find(t[0]), places.find(t[1]), places.find(t[2])};
  return merged;
}

/// Triangles as flat as the rounding of their corners, where edges do not pair up anyway: what they cover up is a
/// T-junction.
std::size_t remove_faulty_slivers(TriangleMesh& mesh) {
  const double near = nearness(mesh);
  const std::vector<std::size_t> uses = uses_of_corners(mesh);
  std::uint32_t index = 0;
  return std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Corner first = 3 * index++;
    if (uses[first] == 2 && uses[first + 1] == 2 && uses[first + 2] == 2) return false;
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    return norm(cross(b - a, c - a)) <= near * longest;
  });
}

std::size_t remove_degenerate(TriangleMesh& mesh) {
  return std::erase_if(mesh.triangles, [&](const Triangle& t) { return is_degenerate(mesh, t); });
}

/// Triangles with the same three corners.
struct Stack {
  std::vector<std::uint32_t> triangles;
  int balance = 0;  // of their windings
  bool two_sided() const { return static_cast<std::size_t>(std::abs(balance)) < triangles.size(); }
};

std::vector<Stack> stacks_of(const TriangleMesh& mesh) {
  std::vector<std::pair<Triangle, std::uint32_t>> keyed(mesh.triangles.size());
  for (std::uint32_t t = 0; t < keyed.size(); ++t) keyed[t] = {sorted(mesh.triangles[t]), t};
  std::sort(keyed.begin(), keyed.end());
  std::vector<Stack> stacks;
  for (std::size_t first = 0, last; first < keyed.size(); first = last) {
    Stack stack;
    for (last = first; last < keyed.size() && keyed[last].first == keyed[first].first; ++last) {
      stack.triangles.push_back(keyed[last].second);
      stack.balance += winding(mesh.triangles[keyed[last].second]);
    }
    if (stack.triangles.size() > 1) stacks.push_back(std::move(stack));
  }
  return stacks;
}

/// Marks the triangles of two-sided patches that are walls between bodies: without the patch, the surfaces at its rim
/// still pair up. A surface that has two sides everywhere has no such rim.
std::vector<bool> triangles_of_walls(const TriangleMesh& mesh, const std::vector<Stack>& stacks) {
  std::vector<bool> two_sided(mesh.triangles.size());
  for (const Stack& stack : stacks)
    for (const std::uint32_t t : stack.triangles) two_sided[t] = stack.two_sided();
  DisjointSets patches(mesh.triangles.size());
  const EdgeTable edges(mesh);
  std::vector<std::pair<std::uint32_t, int>> votes;  // a triangle at a rim, for a wall or against
  edges.for_each([&](std::uint32_t, std::uint32_t, std::span<const Corner> corners) {
    const auto patch = std::find_if(corners.begin(), corners.end(), [&](Corner c) { return two_sided[c / 3]; });
    if (patch == corners.end()) return;
    std::size_t others = 0;
    for (const Corner c : corners)
      if (two_sided[c / 3]) patches.join(*patch / 3, c / 3);
      else ++others;
    if (others > 0) votes.emplace_back(*patch / 3, others % 2 == 0 ? 1 : -1);
  });
  std::vector<int> sums(mesh.triangles.size());
  for (const auto& [triangle, vote] : votes) sums[patches.find(triangle)] += vote;
  std::vector<bool> walls(mesh.triangles.size());
  for (std::uint32_t t = 0; t < walls.size(); ++t) walls[t] = two_sided[t] && sums[patches.find(t)] > 0;
  return walls;
}

std::size_t remove_duplicates(TriangleMesh& mesh) {
  const std::vector<Stack> stacks = stacks_of(mesh);
  if (stacks.empty()) return 0;
  std::vector<bool> removed = triangles_of_walls(mesh, stacks);
  for (const Stack& stack : stacks) {
    if (removed[stack.triangles[0]]) continue;
    const int kept_winding = stack.balance >= 0 ? 1 : -1;
    bool kept = false;
    for (const std::uint32_t t : stack.triangles) {
      removed[t] = kept || winding(mesh.triangles[t]) != kept_winding;
      kept = kept || !removed[t];
    }
  }
  std::uint32_t index = 0;
  return std::erase_if(mesh.triangles, [&](const Triangle&) { return removed[index++]; });
}

struct OnEdge {
  Corner edge;
  double share;  // of the way along it
  std::uint32_t vertex;
  auto operator<=>(const OnEdge&) const = default;
};

/// Vertices of open edges that lie on other open edges.
std::vector<OnEdge> vertices_on_open_edges(const TriangleMesh& mesh) {
  std::vector<Corner> open;
  EdgeTable(mesh).for_each([&](std::uint32_t, std::uint32_t, std::span<const Corner> corners) {
    if (corners.size() == 1) open.push_back(corners[0]);
  });
  if (open.empty()) return {};
  std::vector<std::uint32_t> rim;
  TriangleMesh segments{mesh.vertices, {}};
  for (const Corner c : open) {
    const std::uint32_t a = vertex_at(mesh, c), b = vertex_at(mesh, next_corner(c));
    segments.triangles.push_back({a, b, b});
    rim.insert(rim.end(), {a, b});
  }
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  const double near = nearness(mesh);

  const TriangleTree tree(segments);
  std::vector<OnEdge> found;
  for (const std::uint32_t m : rim) {
    const Vec3 p = mesh.vertices[m];
    for_each_box_near(tree, p, near, [&](std::uint32_t s) {
      const std::uint32_t a = segments.triangles[s][0], b = segments.triangles[s][1];
      if (m == a || m == b) return;
      const Vec3 along = mesh.vertices[b] - mesh.vertices[a], to = p - mesh.vertices[a];
      const double share = dot(to, along) / squared_norm(along);
      const bool inside = share * norm(along) > near && (1 - share) * norm(along) > near;
      if (inside && norm(to - share * along) <= near) found.push_back({open[s], share, m});
    });
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Cuts one edge a triangle; call again until nothing is left.
std::size_t split_open_edges(TriangleMesh& mesh) {
  const std::vector<OnEdge> found = vertices_on_open_edges(mesh);
  std::size_t edges = 0;
  std::uint32_t last_triangle = 0xFFFFFFFF;
  for (std::size_t first = 0, last; first < found.size(); first = last) {
    for (last = first; last < found.size() && found[last].edge == found[first].edge; ++last) {
    }
    const Corner c = found[first].edge;
    if (c / 3 == last_triangle) continue;
    last_triangle = c / 3;
    ++edges;
    const std::uint32_t b = vertex_at(mesh, next_corner(c)), apex = vertex_at(mesh, next_corner(next_corner(c)));
    std::uint32_t from = vertex_at(mesh, c);
    mesh.triangles[c / 3] = {from, found[first].vertex, apex};
    for (std::size_t i = first; i < last; ++i) {
      from = found[i].vertex;
      mesh.triangles.push_back({from, i + 1 < last ? found[i + 1].vertex : b, apex});
    }
  }
  return edges;
}

}  // namespace

Result<TriangleMesh> welded(const TriangleMesh& mesh, const Job& job) {
  constexpr std::uint32_t empty = 0xFFFFFFFF;
  const std::size_t mask = std::bit_ceil(2 * mesh.vertices.size() + 1) - 1;
  std::vector<std::uint32_t> slots(mask + 1, empty);  // of the result's vertices by the hash of their place
  TriangleMesh result;
  std::vector<std::uint32_t> of_vertex(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (v % 65536 == 0 && !job.report(double(v) / double(mesh.vertices.size()), "check")) return cancelled();
    const Place place = place_of(mesh.vertices[v]);
    std::size_t slot = PlaceHash()(place) & mask;
    while (slots[slot] != empty && place_of(result.vertices[slots[slot]]) != place) slot = (slot + 1) & mask;
    if (slots[slot] == empty) {
      slots[slot] = static_cast<std::uint32_t>(result.vertices.size());
      result.vertices.push_back({place[0], place[1], place[2]});
    }
    of_vertex[v] = slots[slot];
  }
  result.triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    result.triangles.push_back({of_vertex[t[0]], of_vertex[t[1]], of_vertex[t[2]]});
  return submesh(result, [](std::uint32_t) { return true; });
}

bool same_triangles(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.triangles.size() != b.triangles.size()) return false;
  std::vector<Placed> in_a = placed(a), in_b = placed(b);
  std::sort(in_a.begin(), in_a.end());
  std::sort(in_b.begin(), in_b.end());
  return in_a == in_b;
}

TriangleMesh new_triangles(const TriangleMesh& mesh, const TriangleMesh& old) {
  std::vector<Placed> in_old = placed(old);
  std::sort(in_old.begin(), in_old.end());
  const std::vector<Placed> in_mesh = placed(mesh);
  return submesh(mesh, [&](std::uint32_t t) { return !std::binary_search(in_old.begin(), in_old.end(), in_mesh[t]); });
}

CleanSoup cleaned(const TriangleMesh& mesh) {
  CleanSoup soup{mesh};
  soup.merged = merge_near_vertices(soup.mesh);
  soup.degenerate = remove_degenerate(soup.mesh) + remove_faulty_slivers(soup.mesh);
  soup.duplicates = remove_duplicates(soup.mesh);
  for (int pass = 0; pass < 4; ++pass) {
    const std::size_t split = split_open_edges(soup.mesh);
    soup.split_edges += split;
    if (split == 0) break;
    remove_degenerate(soup.mesh);
    remove_duplicates(soup.mesh);
  }
  soup.mesh = submesh(soup.mesh, [](std::uint32_t) { return true; });
  return soup;
}

}  // namespace aplomb::detail
