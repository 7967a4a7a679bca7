#include "aplomb/adapters/embree/surface_distance.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <numeric>
#include <vector>

#include "aplomb/mesh/detail/triangle_distance.h"

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

using detail::closest_barycentric;
using Corners = detail::TrianglePoints;

Vec3 at(const Corners& t, Vec3 barycentric) {
  return barycentric.x * t[0] + barycentric.y * t[1] + barycentric.z * t[2];
}

/// Whether three points lie `reach` or farther from a plane, all on one side. normal has length 1.
bool beyond(const Corners& t, Vec3 normal, Vec3 on_plane, double reach) {
  const double a = dot(normal, t[0] - on_plane), b = dot(normal, t[1] - on_plane), c = dot(normal, t[2] - on_plane);
  return std::min({a, b, c}) >= reach || std::max({a, b, c}) <= -reach;
}

/// How far `to` begins beyond the end of `from` in a direction, times its length.
double gap_along(Vec3 direction, const Corners& from, const Corners& to) {
  return std::min({dot(direction, to[0]), dot(direction, to[1]), dot(direction, to[2])}) -
         std::max({dot(direction, from[0]), dot(direction, from[1]), dot(direction, from[2])});
}

Vec3 normal_of(const Corners& t) { return normalized(cross(t[1] - t[0], t[2] - t[0])); }

/// A disc round a triangle, in single precision: a quick way to tell that the triangle lies farther than another.
struct Disc {
  std::array<float, 3> centre, normal;
  float radius;

  Disc(const Corners& t, Vec3 origin, double slack) {
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3, n = normal_of(t);
    double farthest = 0;
    for (const Vec3& corner : t) farthest = std::max(farthest, squared_norm(corner - middle));
    radius = static_cast<float>(std::sqrt(farthest) + slack);
    for (int axis = 0; axis < 3; ++axis) {
      centre[axis] = static_cast<float>((middle - origin)[axis]);
      normal[axis] = static_cast<float>(n[axis]);
    }
  }

  /// Never no when the triangle is so near, whatever single precision loses.
  bool may_be_nearer(const std::array<float, 3>& point, float squared_distance) const {
    const float x = point[0] - centre[0], y = point[1] - centre[1], z = point[2] - centre[2];
    const float squared = x * x + y * y + z * z;
    const float above = x * normal[0] + y * normal[1] + z * normal[2];
    const float beside = std::max(0.0F, std::sqrt(std::max(0.0F, squared - above * above)) - radius);
    return !(above * above + beside * beside > squared_distance + 1e-4F * squared);  // so too without a normal
  }
};

}  // namespace

struct SurfaceDistance::Impl {
  Device device;
  Scene scene;
  TriangleMesh mesh;
  std::vector<std::uint32_t> fan_begin;  // per vertex: its triangles are fan[fan_begin[v] .. fan_begin[v + 1])
  std::vector<std::uint32_t> fan;
  Vec3 origin;              // of the discs' coordinates
  std::vector<Disc> discs;  // one per triangle
  double slack_mm = 0;      // how far a point may move when Embree takes it in single precision

  Corners corners(std::uint32_t triangle) const {
    const Triangle& t = mesh.triangles[triangle];
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  }

  double squared_distance(Vec3 point, std::uint32_t triangle) const {
    const Corners t = corners(triangle);
    return squared_norm(point - at(t, closest_barycentric(point, t)));
  }

  Vec3 normal(std::uint32_t triangle) const { return normal_of(corners(triangle)); }

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

/// What Embree made; where it found no memory, the end is that of operator new.
template <class Made>
Made made(Made pointer) {
  if (pointer) return pointer;
  if (const auto handler = std::get_new_handler()) handler();
  throw std::bad_alloc();
}

void add_triangles(RTCDevice device, RTCScene scene, const TriangleMesh& mesh) {
  const RTCGeometry geometry = made(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* positions = static_cast<float*>(made(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size())));
  for (const Vec3& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) *positions++ = static_cast<float>(v[axis]);
  auto* indices = static_cast<std::uint32_t*>(made(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangles.size())));
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
  impl->origin = 0.5 * (box.min + box.max);
  impl->discs.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    impl->discs.emplace_back(impl->corners(i), impl->origin, 1e-6 * box.diagonal());
  impl->device.reset(made(rtcNewDevice("threads=1")));
  impl->scene.reset(made(rtcNewScene(impl->device.get())));
  rtcSetSceneFlags(impl->scene.get(), RTC_SCENE_FLAG_ROBUST);
  add_triangles(impl->device.get(), impl->scene.get(), impl->mesh);
  rtcCommitScene(impl->scene.get());
  impl_ = std::move(impl);
}

SurfaceDistance::Closest SurfaceDistance::closest(Vec3 point, std::uint32_t hint, double near_enough) const {
  struct Search {
    const Impl& impl;
    Vec3 point;
    double near_enough_squared;
    std::array<float, 3> relative{};
    double squared = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = no_triangle;

    // Box tests see the point in single precision: slack keeps them from missing a triangle.
    float radius() const { return squared <= near_enough_squared ? 0.0F : reach(); }
    float reach() const { return static_cast<float>(std::sqrt(squared) * (1 + 1e-6) + impl.slack_mm); }
  };
  Search search{*impl_, point, near_enough * near_enough};
  if (hint != no_triangle) search.squared = impl_->squared_distance(point, hint), search.triangle = hint;
  if (search.squared <= search.near_enough_squared) return {std::sqrt(search.squared), search.triangle};
  for (int axis = 0; axis < 3; ++axis) search.relative[axis] = static_cast<float>((point - impl_->origin)[axis]);
  RTCPointQuery query{};
  query.x = static_cast<float>(point.x);
  query.y = static_cast<float>(point.y);
  query.z = static_cast<float>(point.z);
  query.radius = search.radius();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto visit = [](RTCPointQueryFunctionArguments* arguments) {
    Search& s = *static_cast<Search*>(arguments->userPtr);
    if (!s.impl.discs[arguments->primID].may_be_nearer(s.relative, static_cast<float>(s.squared))) return false;
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

double SurfaceDistance::from_triangle(Vec3 a, Vec3 b, Vec3 c, double at_most) const {
  struct Search {
    const Impl& impl;
    Corners triangle;
    Vec3 normal, center;
    double around;  // radius of a ball round center that holds the triangle
    double least;

    float radius() const { return static_cast<float>((around + least) * (1 + 1e-6) + impl.slack_mm); }
  };
  Search search{*impl_, {a, b, c}, normal_of({a, b, c}), (a + b + c) / 3, 0, at_most};
  search.around = std::max({norm(a - search.center), norm(b - search.center), norm(c - search.center)});
  RTCPointQuery query{};
  query.x = static_cast<float>(search.center.x);
  query.y = static_cast<float>(search.center.y);
  query.z = static_cast<float>(search.center.z);
  query.radius = search.radius();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto visit = [](RTCPointQueryFunctionArguments* arguments) {
    Search& s = *static_cast<Search*>(arguments->userPtr);
    const Corners other = s.impl.corners(arguments->primID);
    if (beyond(other, s.normal, s.triangle[0], s.least)) return false;
    if (beyond(s.triangle, normal_of(other), other[0], s.least)) return false;
    const Vec3 across = at(other, closest_barycentric(s.center, other)) - s.center;
    if (gap_along(across, s.triangle, other) > s.least * norm(across)) return false;
    const double distance = std::sqrt(detail::squared_distance(s.triangle, other));
    if (distance >= s.least) return false;
    s.least = distance;
    arguments->query->radius = s.radius();
    return true;
  };
  rtcPointQuery(impl_->scene.get(), &query, &context, visit, &search);
  return search.least;
}

SurfaceDistance::Pinch SurfaceDistance::pinch(Vec3 point, Vec3 inward, double at_most, double least_cos) const {
  struct Search {
    const Impl& impl;
    Vec3 point, inward;
    double least_cos;
    Pinch found;
  };
  Search search{*impl_, point, inward, least_cos, {at_most, no_triangle, {}}};
  const Vec3 center = point + at_most * inward;
  RTCPointQuery query{};
  query.x = static_cast<float>(center.x);
  query.y = static_cast<float>(center.y);
  query.z = static_cast<float>(center.z);
  query.radius = static_cast<float>(at_most * (1 + 1e-6) + impl_->slack_mm);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto visit = [](RTCPointQueryFunctionArguments* arguments) {
    Search& s = *static_cast<Search*>(arguments->userPtr);
    const auto& n = s.impl.discs[arguments->primID].normal;
    if (n[0] * s.inward.x + n[1] * s.inward.y + n[2] * s.inward.z < s.least_cos) return false;
    const Corners t = s.impl.corners(arguments->primID);
    // Shrinks the ball to what touches the nearest point of the triangle, until it holds none (Ma, Bae and Choi 2012).
    for (int i = 0; i < 64; ++i) {
      const Vec3 middle = s.point + s.found.radius_mm * s.inward, nearest = at(t, closest_barycentric(middle, t));
      const Vec3 chord = nearest - s.point;
      const double along = dot(chord, s.inward);
      if (!(along > 0)) return false;
      const double radius = squared_norm(chord) / (2 * along);
      if (!(radius < s.found.radius_mm * (1 - 1e-9))) return false;
      s.found = {radius, arguments->primID, nearest};
    }
    return false;
  };
  rtcPointQuery(impl_->scene.get(), &query, &context, visit, &search);
  return search.found.triangle == no_triangle ? Pinch{} : search.found;
}

Vec3 SurfaceDistance::closest_point(Vec3 point, std::uint32_t triangle) const {
  const Corners t = impl_->corners(triangle);
  return at(t, closest_barycentric(point, t));
}

bool SurfaceDistance::inside(Vec3 point, const Closest& nearest) const {
  const Triangle& t = impl_->mesh.triangles[nearest.triangle];
  const Corners corners = impl_->corners(nearest.triangle);
  const Vec3 weights = closest_barycentric(point, corners);
  std::array<std::uint32_t, 3> feature{};
  int size = 0;
  for (int corner = 0; corner < 3; ++corner)
    if (weights[corner] > 0) feature[size++] = t[corner];
  const Vec3 outward = size == 1   ? impl_->vertex_pseudonormal(feature[0])
                       : size == 2 ? impl_->edge_pseudonormal(feature[0], feature[1])
                                   : impl_->normal(nearest.triangle);
  return dot(point - at(corners, weights), outward) < 0;
}

}  // namespace aplomb::adapters
