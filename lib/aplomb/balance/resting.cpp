#include "aplomb/balance/resting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "aplomb/balance/detail/outer_hull.h"

namespace aplomb {
namespace {

/// A facet of the hull over which the centre of mass lies.
struct Candidate {
  Vec3 up;
  double com_height_mm;
};

bool projects_into(Vec3 point, const std::array<Vec3, 3>& corners, Vec3 outward) {
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(cross(corners[(i + 1) % 3] - corners[i], point - corners[i]), outward) < 0) return false;
  return true;
}

std::vector<Candidate> candidates(const TriangleMesh& hull, Vec3 com_mm) {
  std::vector<Candidate> found;
  for (const Triangle& t : hull.triangles) {
    const std::array<Vec3, 3> corners{hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]};
    const Vec3 doubled_area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (squared_norm(doubled_area) == 0 || !projects_into(com_mm, corners, doubled_area)) continue;
    const Vec3 up = -normalized(doubled_area);
    found.push_back({up, dot(up, com_mm - corners[0])});
  }
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.com_height_mm < b.com_height_mm; });
  return found;
}

double degrees(double angle_deg) { return angle_deg * std::numbers::pi / 180; }

}  // namespace

Result<std::vector<RestingFace>> resting_faces(const TriangleMesh& mesh, const Moments& body,
                                               double contact_height_mm) {
  const Result<TriangleMesh> hull = detail::outer_hull(mesh);
  if (!hull) return tl::unexpected(hull.error());
  constexpr std::size_t enough = 64;
  constexpr double same_face_cosine = 0.9999;  // 0.8 degrees
  std::vector<RestingFace> faces;
  const Region region{body, 1};
  for (const Candidate& candidate : candidates(*hull, body.centroid_mm())) {
    if (faces.size() == enough) break;
    if (std::any_of(faces.begin(), faces.end(),
                    [&](const RestingFace& f) { return dot(f.up, candidate.up) > same_face_cosine; }))
      continue;
    const StandingPose pose{.up = candidate.up, .contact_height_mm = contact_height_mm};
    const Result<SupportPolygon> support = support_polygon(*hull, pose);
    if (!support) return tl::unexpected(support.error());
    const Stability stability = measure_stability(*support, {&region, 1}, pose);
    faces.push_back({candidate.up, stability.tip_rad, stability.com_height_mm, support->area_mm2()});
  }
  std::sort(faces.begin(), faces.end(),
            [](const RestingFace& a, const RestingFace& b) { return a.tip_rad > b.tip_rad; });
  return faces;
}

std::optional<RestingHint> resting_hint(const TriangleMesh& mesh, const Moments& body, const StandingPose& pose) {
  const Box3 box = bounding_box(mesh);
  const double fine_mm = 1e-3 * box.diagonal(), coarse_mm = 1e-2 * box.diagonal();
  const auto standing = [&](Vec3 up, double contact_height_mm) {
    const StandingPose upright{.up = up, .contact_height_mm = contact_height_mm};
    const SupportPolygon support = support_polygon(mesh, upright).value();  // no contacts named: it cannot fail
    const Region region{body, 1};
    return std::pair{support, measure_stability(support, {&region, 1}, upright)};
  };
  const Result<std::vector<RestingFace>> faces = resting_faces(mesh, body, fine_mm);
  if (!faces) return std::nullopt;
  const auto rests_square_to = [&](Vec3 up) {
    return std::any_of(faces->begin(), faces->end(),
                       [&](const RestingFace& face) { return dot(face.up, up) > std::cos(degrees(2)); });
  };
  const double flat_base_mm2 = std::pow(0.05 * box.diagonal(), 2);
  if (rests_square_to(pose.up) || standing(pose.up, fine_mm).first.area_mm2() > flat_base_mm2) return std::nullopt;
  const auto [given_support, given] = standing(pose.up, coarse_mm);
  RestingHint hint{std::nullopt, given.tip_rad, given.tip_rad + degrees(10)};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      Vec3 up;
      up[axis] = sign;
      if (!rests_square_to(up)) continue;
      const double tip_rad = standing(up, coarse_mm).second.tip_rad;
      if (tip_rad < hint.suggested_tip_rad) continue;
      hint.up = up;
      hint.suggested_tip_rad = tip_rad;
    }
  const Vec3 size = box.size();
  const bool lies_flat = given_support.height_mm < 0.5 * std::max({size.x, size.y, size.z});
  if (hint.up || (lies_flat && given.tip_rad < degrees(-15))) return hint;
  return std::nullopt;
}

}  // namespace aplomb
