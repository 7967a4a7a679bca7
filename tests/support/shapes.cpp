#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace aplomb::test {
namespace {

using Index = std::uint32_t;

Index index_of(std::size_t i) { return static_cast<Index>(i); }

/// The vertex half-way between two others, on the sphere, made once per edge.
Index midpoint(TriangleMesh& mesh, std::map<std::pair<Index, Index>, Index>& made, Index a, Index b) {
  const auto [place, is_new] = made.try_emplace(std::minmax(a, b), index_of(mesh.vertices.size()));
  if (is_new) mesh.vertices.push_back(normalized(mesh.vertices[a] + mesh.vertices[b]));
  return place->second;
}

/// Unit sphere with a vertex at each pole.
TriangleMesh icosahedron() {
  TriangleMesh mesh;
  const double z = 1 / std::sqrt(5.0), r = 2 * z;
  mesh.vertices.push_back({0, 0, 1});
  for (int i = 0; i < 10; ++i) {
    const double angle = i * std::numbers::pi / 5;
    mesh.vertices.push_back({r * std::cos(angle), r * std::sin(angle), i % 2 == 0 ? z : -z});
  }
  mesh.vertices.push_back({0, 0, -1});
  for (Index i = 0; i < 10; i += 2) {
    const Index up = 1 + i, down = 2 + i, next_up = 1 + (i + 2) % 10, next_down = 1 + (i + 3) % 10;
    mesh.triangles.push_back({0, up, next_up});
    mesh.triangles.push_back({up, down, next_up});
    mesh.triangles.push_back({down, next_down, next_up});
    mesh.triangles.push_back({11, next_down, down});
  }
  return mesh;
}

}  // namespace

TriangleMesh box(Vec3 min, Vec3 max) {
  return prism({{min.x, min.y}, {max.x, min.y}, {max.x, max.y}, {min.x, max.y}}, min.z, {0, 0, max.z - min.z});
}

TriangleMesh tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  if (dot(cross(b - a, c - a), d - a) < 0) std::swap(b, c);
  return {{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TriangleMesh prism(const std::vector<Vec2>& base, double bottom_mm, Vec3 sweep) {
  TriangleMesh mesh;
  const std::size_t n = base.size();
  for (const Vec2& p : base) mesh.vertices.push_back({p.x, p.y, bottom_mm});
  for (const Vec2& p : base) mesh.vertices.push_back(Vec3{p.x, p.y, bottom_mm} + sweep);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, index_of(i + 1), index_of(i)});
    mesh.triangles.push_back({index_of(n), index_of(n + i), index_of(n + i + 1)});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    mesh.triangles.push_back({index_of(i), index_of(next), index_of(n + next)});
    mesh.triangles.push_back({index_of(i), index_of(n + next), index_of(n + i)});
  }
  return mesh;
}

TriangleMesh leaning_prism(double width_mm, double depth_mm, double height_mm, double lean_mm) {
  const double x = width_mm / 2, y = depth_mm / 2;
  return prism({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, 0, {lean_mm, 0, height_mm});
}

std::vector<Vec2> regular_polygon(double radius_mm, int segments) {
  std::vector<Vec2> corners;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    corners.push_back({radius_mm * std::cos(angle), radius_mm * std::sin(angle)});
  }
  return corners;
}

TriangleMesh frustum(Vec3 base_mm, double bottom_radius_mm, double top_radius_mm, double height_mm, int segments) {
  TriangleMesh mesh;
  const auto ring = [&](double radius_mm, double z_mm) {  // first vertex of the ring, or the apex
    const std::size_t first = mesh.vertices.size();
    if (radius_mm == 0) mesh.vertices.push_back(base_mm + Vec3{0, 0, z_mm});
    else
      for (const Vec2& p : regular_polygon(radius_mm, segments))
        mesh.vertices.push_back(base_mm + Vec3{p.x, p.y, z_mm});
    return first;
  };
  const std::size_t bottom = ring(bottom_radius_mm, 0), top = ring(top_radius_mm, height_mm);
  const auto n = static_cast<std::size_t>(segments);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    if (bottom_radius_mm != 0)
      mesh.triangles.push_back(
          {index_of(bottom + i), index_of(bottom + next), index_of(top_radius_mm == 0 ? top : top + next)});
    if (top_radius_mm != 0)
      mesh.triangles.push_back(
          {index_of(bottom_radius_mm == 0 ? bottom : bottom + i), index_of(top + next), index_of(top + i)});
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (bottom_radius_mm != 0)
      mesh.triangles.push_back({index_of(bottom), index_of(bottom + i + 1), index_of(bottom + i)});
    if (top_radius_mm != 0) mesh.triangles.push_back({index_of(top), index_of(top + i), index_of(top + i + 1)});
  }
  return mesh;
}

TriangleMesh cylinder(Vec3 base_mm, double radius_mm, double height_mm, int segments) {
  return frustum(base_mm, radius_mm, radius_mm, height_mm, segments);
}

TriangleMesh cone(Vec3 base_mm, double radius_mm, double height_mm, int segments) {
  return frustum(base_mm, radius_mm, 0, height_mm, segments);
}

TriangleMesh sphere(Vec3 center_mm, double radius_mm, int subdivisions) {
  TriangleMesh mesh = icosahedron();
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<Index, Index>, Index> made;
    std::vector<Triangle> finer;
    for (const Triangle& t : std::vector<Triangle>(mesh.triangles)) {
      const Index ab = midpoint(mesh, made, t[0], t[1]), bc = midpoint(mesh, made, t[1], t[2]),
                  ca = midpoint(mesh, made, t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Vec3& v : mesh.vertices) v = center_mm + radius_mm * v;
  return mesh;
}

TriangleMesh torus(Vec3 center_mm, double major_radius_mm, double minor_radius_mm, int major_segments,
                   int minor_segments) {
  TriangleMesh mesh;
  const std::vector<Vec2> profile = regular_polygon(minor_radius_mm, minor_segments);
  for (const Vec2& around : regular_polygon(1, major_segments))
    for (const Vec2& p : profile)
      mesh.vertices.push_back(center_mm +
                              Vec3{(major_radius_mm + p.x) * around.x, (major_radius_mm + p.x) * around.y, p.y});
  const auto vertex = [&](int i, int j) {
    return index_of(static_cast<std::size_t>(i % major_segments) * profile.size() +
                    static_cast<std::size_t>(j % minor_segments));
  };
  for (int i = 0; i < major_segments; ++i)
    for (int j = 0; j < minor_segments; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return mesh;
}

TriangleMesh with_void(TriangleMesh outer, TriangleMesh inner) {
  return joined(std::move(outer), reversed(std::move(inner)));
}

Affine3 translation(Vec3 by_mm) { return {{}, by_mm}; }

Affine3 scaling(double factor) { return {{{{{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}}}}, {}}; }

Affine3 rotation(Vec3 axis, double angle_rad) {
  const Vec3 u = normalized(axis);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const Mat3 linear{{{{c + (1 - c) * u.x * u.x, (1 - c) * u.x * u.y - s * u.z, (1 - c) * u.x * u.z + s * u.y},
                      {(1 - c) * u.y * u.x + s * u.z, c + (1 - c) * u.y * u.y, (1 - c) * u.y * u.z - s * u.x},
                      {(1 - c) * u.z * u.x - s * u.y, (1 - c) * u.z * u.y + s * u.x, c + (1 - c) * u.z * u.z}}}};
  return {linear, {}};
}

}  // namespace aplomb::test
