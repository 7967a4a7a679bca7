#include "figure.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "aplomb/mesh/mass_properties.h"

namespace aplomb::picture {

Result<Figure> stood_up(TriangleMesh mesh, Vec3 up, double contact_height_mm) {
  const PlateFrame frame = plate_frame(up, 0);
  double lowest = std::numeric_limits<double>::infinity();
  for (Vec3& v : mesh.vertices) {
    const Vec2 on_plate = frame.on_plate(v);
    v = {on_plate.x, on_plate.y, frame.height_mm(v)};
    lowest = std::min(lowest, v.z);
  }
  for (Vec3& v : mesh.vertices) v.z -= lowest;
  const Region body{moments(mesh), 1e-3, 0};
  if (!(body.moments.volume_mm3 > 0)) {
    return fail(ErrorCode::unusable_input, "the mesh encloses no volume: repair it first");
  }
  StandingPose pose;
  pose.contact_height_mm = contact_height_mm;
  return measure_standing(mesh, {&body, 1}, pose).map([&](Standing standing) {
    return Figure{std::move(mesh), std::move(standing)};
  });
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

Cut section_along(const Figure& figure, Vec3 heading, double azimuth_rad) {
  const Vec3 across = normalized(cross(heading, Vec3{0, 0, 1}));
  const Vec3 viewer{std::cos(azimuth_rad), std::sin(azimuth_rad), 0};
  return {figure.standing.stability.com_mm, dot(across, viewer) > 0 ? across : -across};
}

std::string verdict(const Figure& figure) {
  const double tip_deg = figure.standing.stability.tip_rad * 180 / std::numbers::pi;
  if (tip_deg <= 0) return "falls";
  char text[48];
  std::snprintf(text, sizeof text, "stands to %.1f\xC2\xB0", tip_deg);
  return text;
}

}  // namespace aplomb::picture
