#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::picture {

/// Parallel projection onto samples: x to the right, y down, z towards the viewer (in mm).
struct Camera {
  Vec3 right, up, back;
  Vec3 centre;  ///< seen in the middle
  double samples_per_mm = 1;
  int width = 0, height = 0;  ///< in samples

  Vec3 project(Vec3 p) const {
    const Vec3 d = p - centre;
    return {0.5 * width + samples_per_mm * dot(d, right), 0.5 * height - samples_per_mm * dot(d, up), dot(d, back)};
  }
  Vec3 unproject(double x, double y, double z) const {
    return centre + (x - 0.5 * width) / samples_per_mm * right - (y - 0.5 * height) / samples_per_mm * up + z * back;
  }
};

/// \pre `back`, towards the viewer, has length 1.
Camera camera_towards(Vec3 back);

/// Calls emit(sample, depth, triangle, facing the viewer) for every sample whose centre a triangle covers.
template <class Emit>
void rasterize(const TriangleMesh& mesh, const Camera& camera, Emit&& emit) {
  std::vector<Vec3> at;
  at.reserve(mesh.vertices.size());
  for (const Vec3 vertex : mesh.vertices) at.push_back(camera.project(vertex));
  constexpr double offset = 0.5 + 1.0 / 4099;  // samples never fall on edges of round coordinates
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const Vec3 a = at[corners[0]], b = at[corners[1]], c = at[corners[2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) continue;
    const int x0 = std::max(0, int(std::ceil(std::min({a.x, b.x, c.x}) - offset)));
    const int x1 = std::min(camera.width - 1, int(std::floor(std::max({a.x, b.x, c.x}) - offset)));
    const int y0 = std::max(0, int(std::ceil(std::min({a.y, b.y, c.y}) - offset)));
    const int y1 = std::min(camera.height - 1, int(std::floor(std::max({a.y, b.y, c.y}) - offset)));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double px = x + offset, py = y + offset;
        const double wa = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
        const double wb = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
        const double wc = ((a.x - px) * (b.y - py) - (a.y - py) * (b.x - px)) / area;
        if (wa < 0 || wb < 0 || wc < 0) continue;
        emit(std::size_t(y) * std::size_t(camera.width) + std::size_t(x), wa * a.z + wb * b.z + wc * c.z, t, area < 0);
      }
    }
  }
}

}  // namespace aplomb::picture
