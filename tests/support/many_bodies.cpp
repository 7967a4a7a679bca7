#include "support/many_bodies.h"

#include <array>
#include <cmath>

namespace aplomb::test {
namespace {

/// `body(i)` gives the four corners, positively oriented.
template <class Body>
TriangleMesh bodies(int count, const Body& body) {
  TriangleMesh mesh;
  mesh.vertices.reserve(4 * std::size_t(count));
  mesh.triangles.reserve(4 * std::size_t(count));
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& corner : body(i)) mesh.vertices.push_back(corner);
    for (const auto& [a, b, c] : {Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
      mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

std::array<Vec3, 4> tetrahedron(Vec3 at, double size) {
  return {at, at + Vec3{size, 0, 0}, at + Vec3{0, size, 0}, at + Vec3{0, 0, size}};
}

}  // namespace

TriangleMesh tetrahedra_apart(int count) {
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  return bodies(count, [side](int i) { return tetrahedron({2.0 * (i % side), 2.0 * (i / side), 0}, 1); });
}

TriangleMesh tetrahedra_stacked(int count) {
  return bodies(count, [](int i) { return tetrahedron({0, 0, 2.0 * i}, 1); });
}

TriangleMesh tetrahedra_nested(int count, bool innermost_first) {
  return bodies(count, [=](int i) {
    const double size = 10.0 + 0.25 * (innermost_first ? i : count - i);
    return tetrahedron(-size / 4 * Vec3{1, 1, 1}, size);
  });
}

TriangleMesh tetrahedra_crossing(int count) {
  return bodies(count, [count](int i) {
    const double turn = 2 * M_PI * i / count, x = std::cos(turn), y = std::sin(turn), low = -0.001 * i;
    return std::array<Vec3, 4>{
        Vec3{-20 * x, -20 * y, low}, {20 * x - y, 20 * y + x, low}, {20 * x + y, 20 * y - x, low}, {0, 0, 30 - low}};
  });
}

TriangleMesh needles_slanted(int count) {
  return bodies(count, [](int i) {
    const Vec3 at{0.5 * i, -0.5 * i, 0}, far = at + Vec3{40000, 40000, 40000};
    return std::array<Vec3, 4>{at, far, far + Vec3{0, 0.125, 0}, far + Vec3{0, 0, 0.125}};
  });
}

}  // namespace aplomb::test
