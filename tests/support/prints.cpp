#include "support/prints.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace aplomb::test {
namespace {

using Index = std::uint32_t;

void add_quad(TriangleMesh& mesh, Index a, Index b, Index c, Index d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

}  // namespace

Print print_of(const TriangleMesh& mesh, double layer_mm) {
  PrintedSolid printed = printed_solid(solid_of(mesh));
  Slices slices = cut_slices(printed, layer_mm).value();
  return {std::move(printed), std::move(slices)};
}

TriangleMesh tower(const std::vector<Vec2>& outline, const std::vector<Vec3>& offsets) {
  TriangleMesh mesh;
  const auto n = static_cast<Index>(outline.size()), rings = static_cast<Index>(offsets.size());
  for (const Vec3& offset : offsets)
    for (const Vec2& q : outline) mesh.vertices.push_back({q.x + offset.x, q.y + offset.y, offset.z});
  for (Index ring = 0; ring + 1 < rings; ++ring)
    for (Index i = 0; i < n; ++i) {
      const Index a = ring * n + i, b = ring * n + (i + 1) % n;
      add_quad(mesh, a, b, b + n, a + n);
    }
  const Index top = n * (rings - 1);
  for (Index i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({top, top + i, top + i + 1});
  }
  return mesh;
}

TriangleMesh strip(const std::vector<Vec2>& left, const std::vector<Vec2>& right, double depth_mm) {
  TriangleMesh mesh;
  const auto n = static_cast<Index>(left.size());
  for (const double y : {0.0, depth_mm})
    for (const std::vector<Vec2>* line : {&left, &right})
      for (const Vec2& q : *line) mesh.vertices.push_back({q.x, y, q.y});
  const Index l = 0, r = n, back = 2 * n;
  for (Index i = 0; i + 1 < n; ++i) {
    add_quad(mesh, r + i, r + i + 1, l + i + 1, l + i);                              // front, seen along +y
    add_quad(mesh, back + l + i, back + l + i + 1, back + r + i + 1, back + r + i);  // back
    add_quad(mesh, l + i, l + i + 1, back + l + i + 1, back + l + i);
    add_quad(mesh, r + i + 1, r + i, back + r + i, back + r + i + 1);
  }
  add_quad(mesh, r, l, back + l, back + r);
  add_quad(mesh, l + n - 1, r + n - 1, back + r + n - 1, back + l + n - 1);
  return mesh;
}

TriangleMesh ring(const std::vector<Vec2>& profile, int segments) {
  TriangleMesh mesh;
  const auto n = static_cast<Index>(profile.size()), turns = static_cast<Index>(segments);
  for (Index i = 0; i < turns; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    for (const Vec2& q : profile) mesh.vertices.push_back({q.x * std::cos(angle), q.x * std::sin(angle), q.y});
  }
  for (Index i = 0; i < turns; ++i)
    for (Index k = 0; k < n; ++k) {
      const Index a = i * n + k, b = i * n + (k + 1) % n, next = ((i + 1) % turns) * n;
      add_quad(mesh, a, next + k, next + (k + 1) % n, b);
    }
  return mesh;
}

}  // namespace aplomb::test
