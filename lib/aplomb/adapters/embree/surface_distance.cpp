#include "aplomb/adapters/embree/surface_distance.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace aplomb::adapters {
namespace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

/// Barycentric coordinates of the point of triangle (a, b, c) closest to p: exact zeros name the feature.
Vec3 closest_barycentric(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

struct Corners {
  Vec3 a, b, c;
  Vec3 at(Vec3 barycentric) const { return barycentric.x * a + barycentric.y * b + barycentric.z * c; }
};

}  // namespace

struct SurfaceDistance::Impl {
  Device device;
  Scene scene;
  TriangleMesh mesh;
  std::vector<std::uint32_t> fan_begin;  // per vertex: its triangles are fan[fan_begin[v] .. fan_begin[v + 1])
  std::vector<std::uint32_t> fan;
  double slack_mm = 0;  // how far a point may move when Embree takes it in single precision

  Corners corners(std::uint32_t triangle) const {
    const Triangle& t = mesh.triangles[triangle];
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  }

  double squared_distance(Vec3 point, std::uint32_t triangle) const {
    const Corners t = corners(triangle);
    return squared_norm(point - t.at(closest_barycentric(point, t.a, t.b, t.c)));
  }

  Vec3 normal(std::uint32_t triangle) const {
    const Corners t = corners(triangle);
    return normalized(cross(t.b - t.a, t.c - t.a));
  }

  Vec3 edge_pseudonormal(std::uint32_t v, std::uint32_t w) const {
    Vec3 sum;
    for (std::uint32_t i = fan_begin[v]; i < fan_begin[v + 1]; ++i)
      if (std::ranges::count(mesh.triangles[fan[i]], w) > 0) sum += normal(fan[i]);
    return sum;
  }

  Vec3 vertex_pseudonormal(std::uint32_t v) const {
    Vec3 sum;
    for (std::uint32_t i = fan_begin[v]; i < fan_begin[v + 1]; ++i) {
      const Triangle& t = mesh.triangles[fan[i]];
      const auto corner = std::ranges::find(t, v) - t.begin();
      const Vec3 one = mesh.vertices[t[(corner + 1) % 3]] - mesh.vertices[v];
      const Vec3 other = mesh.vertices[t[(corner + 2) % 3]] - mesh.vertices[v];
      sum += std::atan2(norm(cross(one, other)), dot(one, other)) * normal(fan[i]);
    }
    return sum;
  }
};

namespace {

void build_fans(const TriangleMesh& mesh, std::vector<std::uint32_t>& begin, std::vector<std::uint32_t>& fan) {
  begin.assign(mesh.vertices.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++begin[v + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  fan.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t v : mesh.triangles[i]) fan[next[v]++] = i;
}

void add_triangles(RTCDevice device, RTCScene scene, const TriangleMesh& mesh) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                3 * sizeof(float), mesh.vertices.size()));
  for (const Vec3& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) *positions++ = static_cast<float>(v[axis]);
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) indices = std::copy(t.begin(), t.end(), indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace

SurfaceDistance::SurfaceDistance(const TriangleMesh& mesh) {
  assert(!mesh.triangles.empty());
  auto impl = std::make_shared<Impl>();
  impl->mesh = mesh;
  build_fans(mesh, impl->fan_begin, impl->fan);
  const Box3 box = bounding_box(mesh);
  double reach = 0;
  for (int axis = 0; axis < 3; ++axis) reach = std::max({reach, std::abs(box.min[axis]), std::abs(box.max[axis])});
  impl->slack_mm = 8 * static_cast<double>(std::numeric_limits<float>::epsilon()) * reach;
  impl->device.reset(rtcNewDevice("threads=1"));
  impl->scene.reset(rtcNewScene(impl->device.get()));
  rtcSetSceneFlags(impl->scene.get(), RTC_SCENE_FLAG_ROBUST);
  add_triangles(impl->device.get(), impl->scene.get(), impl->mesh);
  rtcCommitScene(impl->scene.get());
  impl_ = std::move(impl);
}

SurfaceDistance::Closest SurfaceDistance::closest(Vec3 point, std::uint32_t hint) const {
  struct Search {
    const Impl& impl;
    Vec3 point;
    double squared = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = no_triangle;

    // Box tests see the point in single precision: slack keeps them from missing a triangle.
    float radius() const { return static_cast<float>(std::sqrt(squared) * (1 + 1e-6) + impl.slack_mm); }
  };
  Search search{*impl_, point};
  if (hint != no_triangle) search.squared = impl_->squared_distance(point, hint), search.triangle = hint;
  RTCPointQuery query{};
  query.x = static_cast<float>(point.x);
  query.y = static_cast<float>(point.y);
  query.z = static_cast<float>(point.z);
  query.radius = search.radius();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto visit = [](RTCPointQueryFunctionArguments* arguments) {
    Search& s = *static_cast<Search*>(arguments->userPtr);
    const double squared = s.impl.squared_distance(s.point, arguments->primID);
    if (squared >= s.squared) return false;
    s.squared = squared;
    s.triangle = arguments->primID;
    arguments->query->radius = s.radius();
    return true;
  };
  rtcPointQuery(impl_->scene.get(), &query, &context, visit, &search);
  return {std::sqrt(search.squared), search.triangle};
}

Vec3 SurfaceDistance::closest_point(Vec3 point, std::uint32_t triangle) const {
  const Corners t = impl_->corners(triangle);
  return t.at(closest_barycentric(point, t.a, t.b, t.c));
}

bool SurfaceDistance::inside(Vec3 point, const Closest& nearest) const {
  const Triangle& t = impl_->mesh.triangles[nearest.triangle];
  const Corners corners = impl_->corners(nearest.triangle);
  const Vec3 weights = closest_barycentric(point, corners.a, corners.b, corners.c);
  std::array<std::uint32_t, 3> feature{};
  int size = 0;
  for (int corner = 0; corner < 3; ++corner)
    if (weights[corner] > 0) feature[size++] = t[corner];
  const Vec3 outward = size == 1   ? impl_->vertex_pseudonormal(feature[0])
                       : size == 2 ? impl_->edge_pseudonormal(feature[0], feature[1])
                                   : impl_->normal(nearest.triangle);
  return dot(point - corners.at(weights), outward) < 0;
}

}  // namespace aplomb::adapters
