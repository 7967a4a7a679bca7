#include "light.h"

#include <numbers>

namespace aplomb::picture {
namespace {

constexpr int map_size = 420;
constexpr int key_lamps = 27;
constexpr int sky_lamps = 108;
constexpr double golden_rad = std::numbers::pi * 0.7639320225;  // the golden angle spreads directions evenly

Lamp lamp(const TriangleMesh& mesh, Vec3 towards, Colour light, const std::optional<Cut>& cut) {
  Lamp out{towards, light, camera_towards(towards), {}};
  const Box3 box = bounding_box(mesh);
  out.camera.centre = 0.5 * (box.min + box.max);
  out.camera.width = out.camera.height = map_size;
  out.camera.samples_per_mm = (map_size - 4) / box.diagonal();
  out.depth.assign(std::size_t(map_size) * map_size, -1e30F);
  const double pixels = 1 / out.camera.samples_per_mm;
  rasterize(mesh, out.camera, [&](std::size_t sample, double z, std::size_t, bool) {
    if (cut) {
      const std::size_t column = sample % map_size, row = sample / map_size;
      const double x = double(column) + 0.5, y = double(row) + 0.5;
      if (dot(out.camera.unproject(x, y, z) - cut->point_mm, cut->normal) > pixels) return;
    }
    out.depth[sample] = std::max(out.depth[sample], float(z));
  });
  return out;
}

void add(Colour& sum, float factor, Colour light) {
  sum = {sum.red + factor * light.red, sum.green + factor * light.green, sum.blue + factor * light.blue};
}

}  // namespace

Camera camera_towards(Vec3 back) {
  Camera camera;
  camera.back = back;
  const Vec3 pole = std::abs(back.z) < 0.999 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  camera.right = normalized(cross(pole, back));
  camera.up = cross(back, camera.right);
  return camera;
}

Lights::Lights(const TriangleMesh& mesh, Vec3 key, const std::optional<Cut>& cut, const Job& job) {
  const auto goes_on = [&] { return job.report(double(lamps_.size()) / (key_lamps + sky_lamps), "picture"); };
  const Camera around = camera_towards(normalized(key));
  for (int i = 0; i < key_lamps; ++i) {
    if (!goes_on()) return;
    const double r = 0.16 * std::sqrt((i + 0.5) / key_lamps), a = golden_rad * i;
    const Vec3 to = normalized(around.back + r * std::cos(a) * around.right + r * std::sin(a) * around.up);
    constexpr float share = 1.0F / key_lamps;
    lamps_.push_back(lamp(mesh, to, {1.02F * share, 0.98F * share, 0.90F * share}, cut));
  }
  for (int i = 0; i < sky_lamps; ++i) {
    if (!goes_on()) return;
    const double z = (i + 0.5) / sky_lamps, r = std::sqrt(1 - z * z), a = golden_rad * i;
    constexpr float share = 2.0F / sky_lamps;
    lamps_.push_back(
        lamp(mesh, {r * std::cos(a), r * std::sin(a), z}, {0.36F * share, 0.38F * share, 0.43F * share}, cut));
  }
  is_complete_ = true;
}

bool Lights::reaches(const Lamp& lamp, Vec3 point, Vec3 normal) const {
  const double texel = 1 / lamp.camera.samples_per_mm;
  const Vec3 p = lamp.camera.project(point + 1.2 * texel * normal);
  if (p.x < 0 || p.y < 0 || p.x >= map_size || p.y >= map_size) return true;
  return lamp.depth[std::size_t(p.y) * map_size + std::size_t(p.x)] <= p.z + 1.2 * texel;
}

Colour Lights::at(Vec3 point, Vec3 normal, std::size_t share, std::size_t shares) const {
  Colour sum;
  const auto gain = static_cast<float>(shares);
  for (std::size_t i = share; i < lamps_.size(); i += shares) {
    const double slope = dot(normal, lamps_[i].towards);
    if (slope > 0 && reaches(lamps_[i], point, normal)) add(sum, gain * float(slope), lamps_[i].light);
  }
  return sum;
}

Colour Lights::share_at(Vec3 point, Vec3 normal, std::size_t share, std::size_t shares) const {
  Colour sum, all;
  for (std::size_t i = share; i < lamps_.size(); i += shares) {
    const double slope = dot(normal, lamps_[i].towards);
    if (slope <= 0) continue;
    add(all, float(slope), lamps_[i].light);
    if (reaches(lamps_[i], point, normal)) add(sum, float(slope), lamps_[i].light);
  }
  return {sum.red / all.red, sum.green / all.green, sum.blue / all.blue};
}

}  // namespace aplomb::picture
