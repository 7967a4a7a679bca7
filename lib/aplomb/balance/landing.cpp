#include "aplomb/balance/landing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "aplomb/balance/detail/outer_hull.h"

namespace aplomb {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// An edge of a face, counter-clockwise seen from outside, and the face beyond it.
struct FaceEdge {
  Vec3 from_mm, to_mm;
  std::size_t beyond = none;
};

/// Facets of the hull in one plane.
struct Face {
  Vec3 outward;  ///< unit vector
  double com_height_mm = 0;
  double chance = 0;
  std::vector<FaceEdge> edges;
};

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

Vec3 doubled_area(const std::array<Vec3, 3>& c) { return cross(c[1] - c[0], c[2] - c[0]); }

double solid_angle(const std::array<Vec3, 3>& corners, Vec3 from) {
  const Vec3 a = corners[0] - from, b = corners[1] - from, d = corners[2] - from;
  const double na = norm(a), nb = norm(b), nd = norm(d);
  return 2 * std::atan2(dot(a, cross(b, d)), na * nb * nd + dot(a, b) * nd + dot(a, d) * nb + dot(b, d) * na);
}

using EdgeOwners = std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;

EdgeOwners owners_of_edges(const TriangleMesh& hull) {
  EdgeOwners owners;
  for (std::size_t i = 0; i < hull.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) owners[{hull.triangles[i][k], hull.triangles[i][(k + 1) % 3]}] = i;
  return owners;
}

/// The face of every facet: neighbours in one plane (or without area) belong together.
std::vector<std::size_t> faces_of_facets(const TriangleMesh& hull, const EdgeOwners& owners) {
  std::vector<std::size_t> root(hull.triangles.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  constexpr double in_one_plane = 1e-5;  // rad: what float32 coordinates leave of a plane
  for (const auto& [edge, facet] : owners) {
    const auto other = owners.find({edge.second, edge.first});
    if (other == owners.end()) continue;
    const Vec3 n = doubled_area(corners_of(hull, hull.triangles[facet]));
    const Vec3 m = doubled_area(corners_of(hull, hull.triangles[other->second]));
    if (norm(cross(n, m)) <= in_one_plane * norm(n) * norm(m)) {
      const auto [first, second] = std::minmax({find(facet), find(other->second)});
      root[second] = first;
    }
  }
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = find(i);
  return root;
}

/// By its edges alone: the same whichever way its corners were split into triangles.
void measure(Face& face, Vec3 com_mm) {
  for (const FaceEdge& edge : face.edges) {
    const std::array corners{face.edges.front().from_mm, edge.from_mm, edge.to_mm};
    face.outward += doubled_area(corners);
    face.chance += solid_angle(corners, com_mm) / (4 * std::numbers::pi);
  }
  if (!(squared_norm(face.outward) > 0)) return;
  face.outward = normalized(face.outward);
  face.com_height_mm = dot(face.outward, face.edges.front().from_mm - com_mm);
}

std::vector<Face> faces_of(const TriangleMesh& hull, Vec3 com_mm) {
  const EdgeOwners owners = owners_of_edges(hull);
  const std::vector<std::size_t> face_of = faces_of_facets(hull, owners);
  std::vector<Face> faces(hull.triangles.size());  // those of roots are used
  for (const auto& [edge, facet] : owners) {
    const auto other = owners.find({edge.second, edge.first});
    if (other == owners.end() || face_of[other->second] == face_of[facet]) continue;
    faces[face_of[facet]].edges.push_back(
        {hull.vertices[edge.first], hull.vertices[edge.second], face_of[other->second]});
  }
  for (Face& face : faces) measure(face, com_mm);
  return faces;
}

double squared_distance_mm2(Vec3 point, Vec3 from, Vec3 to) {
  const Vec3 along = to - from;
  const double share = std::clamp(dot(point - from, along) / squared_norm(along), 0.0, 1.0);
  return squared_norm(point - from - share * along);
}

/// The face that the solid rolls onto, or `none` when it rests.
std::size_t next_face(const std::vector<Face>& faces, std::size_t at, Vec3 com_mm) {
  const Face& face = faces[at];
  const Vec3 foot = com_mm + face.com_height_mm * face.outward;
  std::size_t next = none;
  std::pair nearest{std::numeric_limits<double>::infinity(), 0.0};
  for (const FaceEdge& edge : face.edges) {
    const double inside_mm = dot(normalized(cross(face.outward, edge.to_mm - edge.from_mm)), foot - edge.from_mm);
    const std::pair here{squared_distance_mm2(foot, edge.from_mm, edge.to_mm), inside_mm};
    if (inside_mm >= 0 || !(here < nearest)) continue;
    nearest = here;
    next = edge.beyond;
  }
  return next != none && faces[next].com_height_mm < face.com_height_mm ? next : none;
}

/// The chances of all faces, moved to where the solid ends.
void roll(std::vector<Face>& faces, Vec3 com_mm) {
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return faces[a].com_height_mm > faces[b].com_height_mm; });
  for (const std::size_t i : order) {  // it only ever rolls onto a face that comes later
    if (faces[i].chance == 0) continue;
    const std::size_t next = next_face(faces, i, com_mm);
    if (next == none) continue;
    faces[next].chance += faces[i].chance;
    faces[i].chance = 0;
  }
}

/// The likeliest first, each with those that lie almost in its plane.
std::vector<Face> merged(std::vector<Face> faces) {
  constexpr double same_face_cosine = 0.9999;  // 0.8 degrees
  std::erase_if(faces, [](const Face& face) { return !(face.chance > 0); });
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.chance > b.chance; });
  std::vector<Face> kept;
  for (const Face& face : faces) {
    const auto same = std::find_if(kept.begin(), kept.end(),
                                   [&](const Face& k) { return dot(k.outward, face.outward) > same_face_cosine; });
    if (same != kept.end()) same->chance += face.chance;
    else kept.push_back(face);
  }
  std::stable_sort(kept.begin(), kept.end(), [](const Face& a, const Face& b) { return a.chance > b.chance; });
  return kept;
}

}  // namespace

Result<std::vector<Landing>> landings(const TriangleMesh& mesh, const Moments& body, double contact_height_mm) {
  const Result<TriangleMesh> hull = detail::outer_hull(mesh);
  if (!hull) return tl::unexpected(hull.error());
  const Vec3 com_mm = body.centroid_mm();
  std::vector<Face> faces = faces_of(*hull, com_mm);
  roll(faces, com_mm);
  constexpr std::size_t most = 64;
  const Region region{body, 1};
  std::vector<Landing> found;
  for (const Face& face : merged(std::move(faces))) {
    if (found.size() == most) break;
    const StandingPose pose{.up = -face.outward, .contact_height_mm = contact_height_mm};
    const Result<SupportPolygon> support = support_polygon(*hull, pose);
    if (!support) return tl::unexpected(support.error());
    const Stability s = measure_stability(*support, {&region, 1}, pose);
    if (s.tip_rad > 0) found.push_back({{pose.up, s.tip_rad, s.com_height_mm, support->area_mm2()}, face.chance});
  }
  return found;
}

}  // namespace aplomb
