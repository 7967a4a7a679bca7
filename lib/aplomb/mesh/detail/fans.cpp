#include "aplomb/mesh/detail/fans.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "aplomb/mesh/detail/topology.h"

namespace aplomb::detail {
namespace {

/// A triangle at an edge, by its angle about it. Turning that way, one enters the solid through triangles that run
/// backward along the edge and leaves it through those that run forward.
struct Leaf {
  double angle_rad;
  bool leaves;
  Corner corner;
};

constexpr double same_angle_rad = 1e-7;

std::vector<Leaf> leaves_round(const TriangleMesh& mesh, std::uint32_t low, std::uint32_t high,
                               std::span<const Corner> corners) {
  const Vec3 origin = mesh.vertices[low], axis = normalized(mesh.vertices[high] - origin);
  const auto outward = [&](Corner c) {
    const Vec3 to = mesh.vertices[vertex_at(mesh, next_corner(next_corner(c)))] - origin;
    return to - dot(to, axis) * axis;
  };
  const Vec3 first = outward(corners[0]), across = cross(axis, first);
  std::vector<Leaf> leaves;
  for (const Corner c : corners) {
    const Vec3 to = outward(c);
    double angle_rad = std::atan2(dot(to, across), dot(to, first));
    if (angle_rad < -same_angle_rad) angle_rad += 2 * std::numbers::pi;
    leaves.push_back({angle_rad, vertex_at(mesh, c) == low, c});
  }
  std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.angle_rad < b.angle_rad; });
  for (std::size_t i = 1; i < leaves.size(); ++i)  // walls that coincide: first out of one solid, then into the next
    if (leaves[i].angle_rad - leaves[i - 1].angle_rad < same_angle_rad) leaves[i].angle_rad = leaves[i - 1].angle_rad;
  std::stable_sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) {
    return a.angle_rad != b.angle_rad ? a.angle_rad < b.angle_rad : a.leaves > b.leaves;
  });
  return leaves;
}

/// Pairs of corners that bound a wedge; empty when ways in and out do not balance.
std::vector<std::pair<Corner, Corner>> wedges(std::vector<Leaf> leaves) {
  int depth = 0, least = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    depth += leaves[i].leaves ? -1 : 1;
    if (depth < least) {
      least = depth;
      start = i + 1;
    }
  }
  if (depth != 0) return {};
  std::rotate(leaves.begin(), leaves.begin() + static_cast<std::ptrdiff_t>(start % leaves.size()), leaves.end());
  std::vector<Corner> entered;
  std::vector<std::pair<Corner, Corner>> pairs;
  for (const Leaf& leaf : leaves) {
    if (!leaf.leaves) {
      entered.push_back(leaf.corner);
    } else {
      pairs.emplace_back(entered.back(), leaf.corner);
      entered.pop_back();
    }
  }
  return pairs;
}

}  // namespace

TriangleMesh cut_apart(const TriangleMesh& mesh) {
  DisjointSets fans(3 * mesh.triangles.size());
  const auto join = [&](Corner c, Corner d, std::uint32_t low) {
    const auto at = [&](Corner corner, bool at_low) {
      return (vertex_at(mesh, corner) == low) == at_low ? corner : next_corner(corner);
    };
    for (const bool at_low : {true, false}) fans.join(at(c, at_low), at(d, at_low));
  };
  EdgeTable(mesh).for_each([&](std::uint32_t low, std::uint32_t high, std::span<const Corner> corners) {
    if (corners.size() == 2) join(corners[0], corners[1], low);
    if (corners.size() > 2)
      for (const auto& [in, out] : wedges(leaves_round(mesh, low, high, corners))) join(in, out, low);
  });
  TriangleMesh cut;
  cut.triangles.resize(mesh.triangles.size());
  std::vector<std::uint32_t> numbers(3 * mesh.triangles.size());
  for (Corner c = 0; c < numbers.size(); ++c) {
    const Corner root = fans.find(c);  // the smallest member, so numbered already
    if (root == c) {
      numbers[c] = static_cast<std::uint32_t>(cut.vertices.size());
      cut.vertices.push_back(mesh.vertices[vertex_at(mesh, c)]);
    }
    cut.triangles[c / 3][c % 3] = numbers[root];
  }
  return cut;
}

SetApart set_apart(const TriangleMesh& cut) {
  std::vector<Vec3> normals(cut.vertices.size());
  double largest = 0;
  for (const auto& [a, b, c] : cut.triangles) {
    const Vec3 normal = cross(cut.vertices[b] - cut.vertices[a], cut.vertices[c] - cut.vertices[a]);
    for (const std::uint32_t v : {a, b, c}) normals[v] += normal;
  }
  std::map<std::array<double, 3>, std::size_t> fans_at;
  for (const Vec3& v : cut.vertices) {
    ++fans_at[{v.x, v.y, v.z}];
    largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  }
  SetApart apart{cut, 0, std::ldexp(largest, -17)};
  for (std::size_t i = 0; i < cut.vertices.size(); ++i) {
    Vec3& v = apart.mesh.vertices[i];
    if (fans_at.at({v.x, v.y, v.z}) < 2 || squared_norm(normals[i]) == 0) continue;
    v -= apart.distance_mm * normalized(normals[i]);
  }
  for (const auto& [place, fans] : fans_at) apart.places += fans > 1;
  return apart;
}

}  // namespace aplomb::detail
