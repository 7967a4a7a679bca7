#include "aplomb/mesh/mass_properties.h"

namespace aplomb {

Moments moments(const TriangleMesh& mesh) {
  const Box3 box = bounding_box(mesh);
  if (box.empty()) return {};
  const Vec3 origin = 0.5 * (box.min + box.max);
  double six_volumes = 0;
  Vec3 twenty_four_firsts;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin, c = mesh.vertices[t[2]] - origin;
    const double six_volume = dot(a, cross(b, c));  // of the tetrahedron (origin, a, b, c)
    six_volumes += six_volume;
    twenty_four_firsts += six_volume * (a + b + c);
  }
  const double volume = six_volumes / 6;
  return {volume, twenty_four_firsts / 24 + volume * origin};
}

}  // namespace aplomb
