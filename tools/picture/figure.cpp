#include "figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "aplomb/mesh/mass_properties.h"
#include "aplomb/mesh/placement.h"

namespace aplomb::picture {

namespace {

/// Sets a mesh and the points that go with it down on z = 0, by a map of which `turn` is the linear part.
Affine3 set_down(TriangleMesh& mesh, const Mat3& turn) {
  double lowest = std::numeric_limits<double>::infinity();
  for (Vec3& v : mesh.vertices) {
    v = turn * v;
    lowest = std::min(lowest, v.z);
  }
  for (Vec3& v : mesh.vertices) v.z -= lowest;
  return {turn, {0, 0, -lowest}};
}

/// `inserts` are where they were before the mesh was set down.
Result<Region> body_of(const TriangleMesh& mesh, const Moments& inserts, const Affine3& down) {
  const Moments moved{inserts.volume_mm3, down.linear * inserts.first_mm4 + inserts.volume_mm3 * down.translation};
  const Region body{moments(mesh) + moved, 1e-3, 0};
  if (!(body.moments.volume_mm3 > 0))
    return fail(ErrorCode::unusable_input, "the mesh encloses no volume: repair it first");
  return body;
}

std::string degrees_text(const char* before, double angle_rad) {
  char text[64];
  std::snprintf(text, sizeof text, "%s%.1f\xC2\xB0", before, angle_rad * 180 / std::numbers::pi);
  return text;
}

/// The turn with which a body comes to rest that is free to turn about its points of attachment.
Mat3 turn_to_rest(const HangingPose& pose, Vec3 com_mm) {
  const Vec3 p = pose.attachments_mm.front(), q = pose.attachments_mm.back();
  Vec3 thread = p - com_mm, up = pose.up, axis = cross(thread, up);
  if (norm(q - p) > 0) {
    axis = normalized(q - p);
    thread = thread - dot(axis, thread) * axis;
    up = up - dot(axis, up) * axis;
  }
  const Vec3 across = cross(thread, up);
  if (!(norm(axis) > 0)) return {};
  const double sign = dot(across, axis) < 0 ? -1 : 1;
  return rotation_of({axis, sign * std::atan2(norm(across), dot(thread, up))});
}

}  // namespace

Result<Figure> stood_up(TriangleMesh mesh, StandingPose pose, const Moments& inserts) {
  const PlateFrame frame = plate_frame(pose.up, 0);
  const Affine3 down = set_down(mesh, {{{frame.x_axis, frame.y_axis, frame.up}}});
  for (Contact& contact : pose.contacts) contact.center_mm = down * contact.center_mm;
  pose.up = {0, 0, 1};
  return body_of(mesh, inserts, down)
      .and_then([&](const Region& body) {
        return measure_standing(mesh, {&body, 1}, pose);
      })
      .map([&](Standing standing) {
        return Figure{std::move(mesh), std::move(standing), down};
      });
}

Result<Hung> hung(TriangleMesh mesh, const HangingPose& pose, const Moments& inserts) {
  const auto body = body_of(mesh, inserts, {});
  if (!body) return tl::unexpected(body.error());
  const Hanging hanging = measure_hanging({&*body, 1}, pose);
  const PlateFrame frame = plate_frame(pose.up, 0);
  const Mat3 upright{{{frame.x_axis, frame.y_axis, frame.up}}};
  const Affine3 down = set_down(mesh, upright * turn_to_rest(pose, hanging.com_mm));
  Subject subject;
  subject.com_mm = down * hanging.com_mm;
  for (const Vec3& point : pose.attachments_mm) subject.threads_mm.push_back(down * point);
  subject.mesh = std::move(mesh);
  return Hung{std::move(subject), down, degrees_text("hangs askew by ", hanging.tilt_rad)};
}

Subject drawn(const Figure& figure) {
  Subject subject;
  subject.mesh = figure.mesh;
  subject.support_polygon_mm = figure.standing.support.corners_mm;
  subject.com_mm = figure.standing.stability.com_mm;
  return subject;
}

Subject as_it_comes_to_rest(const Figure& figure) {
  Subject subject = drawn(figure);
  Standing standing = figure.standing;
  constexpr int falls = 8;  // over one edge after another, as long as the centre of mass is outside
  for (int fall = 0; fall < falls && standing.stability.margin_mm <= 0; ++fall) {
    const auto& edge = standing.stability.weak_edge_mm;
    const Vec2 from{edge[0].x, edge[0].y}, to{edge[1].x, edge[1].y};
    if (!(norm(to - from) > 0)) break;
    subject = toppled(std::move(subject), from, to);
    StandingPose pose;
    pose.contact_height_mm = 0.3;
    const Region lying{moments(subject.mesh), 1e-3, 0};
    auto measured = measure_standing(subject.mesh, {&lying, 1}, pose);
    if (!measured) break;
    standing = std::move(*measured);
  }
  return subject;
}

double azimuth_for_rad(Vec3 heading) { return std::atan2(-heading.x, heading.y) + 0.32; }

Cut section_along(Vec3 point_mm, Vec3 heading, double azimuth_rad) {
  const Vec3 across = normalized(cross(heading, Vec3{0, 0, 1}));
  const Vec3 viewer{std::cos(azimuth_rad), std::sin(azimuth_rad), 0};
  return {point_mm, dot(across, viewer) > 0 ? across : -across};
}

std::string verdict(const Figure& figure) {
  const double tip_rad = figure.standing.stability.tip_rad;
  return tip_rad <= 0 ? "falls" : degrees_text("stands to ", tip_rad);
}

}  // namespace aplomb::picture
