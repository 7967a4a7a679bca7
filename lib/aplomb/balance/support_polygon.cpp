#include "aplomb/balance/support_polygon.h"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

#include "aplomb/balance/detail/contact_surface.h"
#include "aplomb/balance/detail/convex_hull_2d.h"

namespace aplomb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Heights {
  std::vector<double> above_plate_mm;  ///< per vertex
  double plate_mm = 0;                 ///< of the lowest vertex that a triangle uses
  double top_mm = 0;                   ///< above the plate
};

Heights heights_of(const TriangleMesh& mesh, Vec3 up) {
  Heights heights;
  heights.above_plate_mm.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) heights.above_plate_mm.push_back(dot(up, vertex));
  double low = infinity, high = -infinity;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) {
      low = std::min(low, heights.above_plate_mm[v]);
      high = std::max(high, heights.above_plate_mm[v]);
    }
  for (double& h : heights.above_plate_mm) h -= low;
  heights.plate_mm = low;
  heights.top_mm = high - low;
  return heights;
}

std::vector<Vec3> lowest_surface(const TriangleMesh& mesh, const Heights& heights, double contact_height_mm) {
  std::vector<Vec3> points;
  std::vector<bool> is_taken(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t low : t) {
      const double low_mm = heights.above_plate_mm[low];
      if (low_mm > contact_height_mm) continue;
      if (!is_taken[low]) points.push_back(mesh.vertices[low]);
      is_taken[low] = true;
      for (const std::uint32_t high : t) {
        const double high_mm = heights.above_plate_mm[high];
        if (high_mm > contact_height_mm)
          points.push_back(
              detail::crossing(mesh.vertices[low], low_mm, mesh.vertices[high], high_mm, contact_height_mm));
      }
    }
  return points;
}

std::vector<Vec3> named_surface(const TriangleMesh& mesh, const Heights& heights, const StandingPose& pose,
                                double below_mm) {
  std::vector<Vec3> points;
  const PlateFrame frame = plate_frame(pose.up, heights.plate_mm);
  for (const Contact& contact : pose.contacts)
    if (contact.radius_mm == 0 && std::abs(frame.height_mm(contact.center_mm)) <= below_mm)
      points.push_back(contact.center_mm);
  for (const Triangle& t : mesh.triangles) {
    const std::array<double, 3> h{heights.above_plate_mm[t[0]], heights.above_plate_mm[t[1]],
                                  heights.above_plate_mm[t[2]]};
    if (std::min({h[0], h[1], h[2]}) > below_mm) continue;
    const std::array<Vec3, 3> corners{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    for (const Contact& contact : pose.contacts) {
      if (contact.radius_mm == 0 || !detail::may_touch(corners, contact)) continue;
      const std::vector<Vec3> inside =
          detail::extreme_points_in_ball(detail::part_below(corners, h, below_mm), contact);
      points.insert(points.end(), inside.begin(), inside.end());
    }
  }
  return points;
}

tl::unexpected<Error> nothing_touches(const TriangleMesh& mesh, const Heights& heights, const StandingPose& pose) {
  const PlateFrame frame = plate_frame(pose.up, heights.plate_mm);
  double nearest_mm = infinity;
  for (const Vec3& point : named_surface(mesh, heights, pose, infinity))
    nearest_mm = std::min(nearest_mm, frame.height_mm(point));
  std::ostringstream text;
  if (nearest_mm == infinity)
    text << "no part of the surface lies within the contacts named; move them onto the surface or give them "
            "a larger radius";
  else
    text << "none of the contacts named touches the plate: the nearest is " << nearest_mm << " mm above it, and "
         << pose.contact_height_mm << " mm still touches; name what is lower, or allow it with --contact-height "
         << nearest_mm << "mm or more";
  return fail(ErrorCode::invalid_option, text.str());
}

}  // namespace

double SupportPolygon::area_mm2() const {
  double doubled = 0;
  for (std::size_t i = 2; i < corners_mm.size(); ++i)
    doubled += cross(corners_mm[i - 1] - corners_mm[0], corners_mm[i] - corners_mm[0]);
  return doubled / 2;
}

double SupportPolygon::width_mm() const {
  if (degenerate()) return 0;
  const std::size_t n = corners_mm.size();
  double width = infinity;
  std::size_t far = 1;  // rotating calipers: the corner farthest from the edge only ever moves on, from the edge's end
  for (const SupportEdge& edge : edges()) {
    const auto altitude = [&](std::size_t corner) { return dot(edge.inward, corners_mm[corner % n] - edge.from_mm); };
    for (std::size_t step = 0; step < n && altitude(far + 1) >= altitude(far); ++step) ++far;
    width = std::min(width, altitude(far));
  }
  return width;
}

std::vector<Vec3> SupportPolygon::corners_in_model_mm() const {
  std::vector<Vec3> points;
  for (const Vec2& corner : corners_mm) points.push_back(frame.in_model(corner));
  return points;
}

std::vector<SupportEdge> SupportPolygon::edges() const {
  std::vector<SupportEdge> edges;
  if (corners_mm.size() == 1)
    for (const Vec2 inward : {Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}, Vec2{1, 0}})
      edges.push_back({corners_mm[0], corners_mm[0], inward});
  else
    for (std::size_t i = 0; i < corners_mm.size(); ++i) {
      const Vec2 a = corners_mm[i], b = corners_mm[(i + 1) % corners_mm.size()];
      const Vec2 along = (1 / norm(b - a)) * (b - a);
      edges.push_back({a, b, {-along.y, along.x}});
      if (corners_mm.size() == 2) edges.push_back({b, b, Vec2{} - along});
    }
  return edges;
}

Result<SupportPolygon> support_polygon(const TriangleMesh& mesh, const StandingPose& pose) {
  if (mesh.triangles.empty()) return fail(ErrorCode::unusable_input, "the mesh has no triangles, so nothing can stand");
  const Vec3 up = plate_frame(pose.up, 0).up;
  const Heights heights = heights_of(mesh, up);
  const std::vector<Vec3> touching = pose.contacts.empty() ? lowest_surface(mesh, heights, pose.contact_height_mm)
                                                           : named_surface(mesh, heights, pose, pose.contact_height_mm);
  if (touching.empty()) return nothing_touches(mesh, heights, pose);
  SupportPolygon support;
  support.frame = plate_frame(up, heights.plate_mm);
  support.height_mm = heights.top_mm;
  std::vector<Vec2> points;
  points.reserve(touching.size());
  for (const Vec3& point : touching) points.push_back(support.frame.on_plate(point));
  support.corners_mm = detail::convex_hull(std::move(points));
  return support;
}

}  // namespace aplomb
