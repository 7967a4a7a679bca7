#include "aplomb/mesh/triangle_mesh.h"

#include <utility>

namespace aplomb {

Box3 bounding_box(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3& vertex : mesh.vertices) box.add(vertex);
  return box;
}

TriangleMesh rounded_to_float(TriangleMesh mesh) {
  const auto rounded = [](double value) { return static_cast<double>(static_cast<float>(value)); };
  for (Vec3& v : mesh.vertices) v = {rounded(v.x), rounded(v.y), rounded(v.z)};
  return mesh;
}

TriangleMesh joined(TriangleMesh first, const TriangleMesh& second) {
  const auto shift = static_cast<std::uint32_t>(first.vertices.size());
  first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
  first.triangles.reserve(first.triangles.size() + second.triangles.size());
  for (const Triangle& t : second.triangles) first.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return first;
}

TriangleMesh reversed(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh transformed(TriangleMesh mesh, const Affine3& transform) {
  for (Vec3& vertex : mesh.vertices) vertex = transform * vertex;
  return determinant(transform.linear) < 0 ? reversed(std::move(mesh)) : mesh;
}

}  // namespace aplomb
