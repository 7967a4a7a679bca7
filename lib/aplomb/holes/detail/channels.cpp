#include "aplomb/holes/detail/channels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace aplomb::detail {
namespace {

using adapters::SurfaceDistance;

constexpr int ring_points = 12;
constexpr double least_cos = 0.5;                   // between a channel and the outside's normal at its mouth
constexpr double least_cos_to_nearest = 0.3;        // between a channel and the shortest way out of its seat
constexpr double uneven_ratio = 0.5;                // of the bore's radius: how far the rim may be from a flat one
constexpr double free_ratio = 3;                    // bores of free space before a mouth
constexpr double most_walls = 4, most_bores = 2.5;  // of which a channel may be long, together
constexpr double hiding_mm = 3;                     // of channel that a mouth may cost to look sideways instead of up
constexpr double fence_mm = 1;
constexpr double over_contact_mm = 0.3;

std::vector<Vec3> all_directions() {
  std::vector<Vec3> directions;
  constexpr int count = 96;
  for (int k = 0; k < count; ++k) {  // a Fibonacci lattice
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z), angle = k * 2.399963229728653;
    directions.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  for (int k = 0; k < 24; ++k)
    for (const double z : {0.0, -0.15}) {
      const double r = std::sqrt(1 - z * z), angle = 2 * std::numbers::pi * k / 24;
      directions.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  directions.push_back({0, 0, -1});
  directions.push_back({0, 0, 1});
  return directions;
}

/// Points on a circle about a hole's axis, at its beginning.
std::array<Vec3, ring_points> ring_of(const Hole& hole, double radius_mm) {
  const Vec3 other = std::abs(hole.outward.z) < 0.7 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = normalized(cross(other, hole.outward)), v = cross(hole.outward, u);
  std::array<Vec3, ring_points> ring;
  for (int k = 0; k < ring_points; ++k) {
    const double angle = 2 * std::numbers::pi * k / ring_points;
    ring[static_cast<std::size_t>(k)] = hole.inside_mm + radius_mm * (std::cos(angle) * u + std::sin(angle) * v);
  }
  return ring;
}

/// How far lengths round a circle are from those to a plane, at most; and how steep that plane is.
struct RimFit {
  double off_mm = 0;
  double slope = 0;
};

RimFit fit(const std::array<double, ring_points>& lengths, double radius_mm) {
  double mean = 0, c = 0, s = 0;
  for (int k = 0; k < ring_points; ++k) {
    const double angle = 2 * std::numbers::pi * k / ring_points, length = lengths[static_cast<std::size_t>(k)];
    mean += length / ring_points;
    c += 2 * length * std::cos(angle) / ring_points;
    s += 2 * length * std::sin(angle) / ring_points;
  }
  RimFit rim{0, std::hypot(c, s) / radius_mm};
  for (int k = 0; k < ring_points; ++k) {
    const double angle = 2 * std::numbers::pi * k / ring_points;
    const double plane = mean + c * std::cos(angle) + s * std::sin(angle);
    rim.off_mm = std::max(rim.off_mm, std::abs(lengths[static_cast<std::size_t>(k)] - plane));
  }
  return rim;
}

double distance_between(const Hole& a, const Hole& b) {  // of the axes, as sampled
  double least = std::numeric_limits<double>::infinity();
  constexpr int steps = 24;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      least = std::min(least, norm(a.at(a.end_mm * i / steps) - b.at(b.end_mm * j / steps)));
  return least;
}

}  // namespace

double Channel::lip_mm() const {
  return 0.5 * hole.bore_mm * std::sqrt(std::max(0.0, 1 - hole.outward.z * hole.outward.z));
}

double Channel::axis_sill_mm() const {
  return std::max(hole.at(hole.throat_mm).z, hole.at(hole.mouth_mm).z) - lip_mm();
}

Channels::Channels(const TriangleMesh& outer, const TriangleMesh& surface, const HoleDemand& demand,
                   const HoleFences& fences)
    : outer_mesh_(outer),
      demand_(demand),
      fences_(fences),
      outer_(outer),
      inner_(surface),
      directions_(all_directions()) {
  for (const Pose& pose : fences.poses)
    if (const StandingPose* standing = pose.standing()) {
      double plate = std::numeric_limits<double>::infinity();
      for (const Vec3& v : outer.vertices) plate = std::min(plate, dot(standing->up, v));
      plates_mm_.push_back(plate);
    }
}

std::optional<Vec3> Channels::seat(Vec3 point) const {
  const double radius = 0.5 * bore_mm();
  auto nearest = inner_.closest(point);
  if (!inner_.inside(point, nearest)) return std::nullopt;
  for (int step = 0; nearest.distance_mm < radius; ++step) {
    if (step == 8 || nearest.distance_mm < 0.02 * radius) return std::nullopt;
    const Vec3 away = normalized(point - inner_.closest_point(point, nearest.triangle));
    point += (1.02 * radius - nearest.distance_mm) * away;
    nearest = inner_.closest(point, nearest.triangle);
    if (!inner_.inside(point, nearest)) return std::nullopt;
  }
  const double most = most_walls * demand_.wall_mm + most_bores * bore_mm();
  return outer_.closest(point).distance_mm < most ? std::optional(point) : std::nullopt;
}

/// Sphere tracing; steps of 5 um where the surface is grazed.
std::optional<double> Channels::way_out_mm(const SurfaceDistance& surface, Vec3 from, Vec3 along, double most) const {
  double at = 0;
  auto nearest = surface.closest(from);
  while (surface.inside(from + at * along, nearest)) {
    at += std::max(nearest.distance_mm, 5e-3);
    if (at > most) return std::nullopt;
    nearest = surface.closest(from + at * along, nearest.triangle);
  }
  return at;
}

bool Channels::is_free(Vec3 from, Vec3 along, double length) const {
  for (double at = 0; at < length;) {
    const auto nearest = outer_.closest(from + at * along);
    if (outer_.inside(from + at * along, nearest)) return false;
    at += std::max(nearest.distance_mm, 0.05);
  }
  return true;
}

std::optional<Channel> Channels::channel(Vec3 seat, Vec3 outward) const {
  const double most = most_walls * demand_.wall_mm + most_bores * bore_mm();
  const auto mouth = way_out_mm(outer_, seat, outward, most);
  if (!mouth) return std::nullopt;
  const auto throat = way_out_mm(inner_, seat, outward, *mouth);
  if (!throat || *throat >= *mouth) return std::nullopt;
  Channel channel{{seat, outward, bore_mm(), *throat, *mouth, *mouth, 0}};
  const Triangle& t = outer_mesh_.triangles[outer_.closest(channel.hole.at(*mouth)).triangle];
  const auto& v = outer_mesh_.vertices;
  const Vec3 normal = normalized(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]));
  if (dot(normal, outward) < least_cos) return std::nullopt;
  channel.looks_up = normal.z;
  channel.cost_mm = channel.hole.wall_mm() + hiding_mm * (1 + normal.z);
  return channel;
}

std::vector<Channel> Channels::channels_from(Vec3 seat, double most_sill) const {
  std::vector<Channel> found;
  const auto nearest = outer_.closest(seat);
  const double to_outside = nearest.distance_mm;
  const Vec3 nearest_way = normalized(outer_.closest_point(seat, nearest.triangle) - seat);
  const double most = most_walls * demand_.wall_mm + most_bores * bore_mm();
  for (const Vec3& direction : directions_) {
    if (dot(direction, nearest_way) < least_cos_to_nearest) continue;
    const double lip = 0.5 * bore_mm() * std::sqrt(std::max(0.0, 1 - direction.z * direction.z));
    const double least_rise = direction.z >= 0 ? direction.z * to_outside : direction.z * most;
    if (seat.z + least_rise - lip > most_sill) continue;
    if (auto one = channel(seat, direction)) found.push_back(*one);
  }
  return found;
}

double Channels::sill_mm(const Channel& channel) const {
  const Hole& hole = channel.hole;
  double sill = std::numeric_limits<double>::infinity();
  for (const Vec3& from : ring_of(hole, 0.48 * hole.bore_mm)) {
    const auto mouth = way_out_mm(outer_, from, hole.outward, 2 * hole.mouth_mm);
    const auto throat = way_out_mm(inner_, from, hole.outward, 2 * hole.mouth_mm);
    if (mouth && throat && *throat > 0)
      sill = std::min(sill, from.z + std::max(*throat * hole.outward.z, *mouth * hole.outward.z));
  }
  return sill;
}

bool Channels::has_room(Channel& channel) const {
  Hole& hole = channel.hole;
  const double most = 3 * (most_walls * demand_.wall_mm + most_bores * bore_mm());
  const double bore = 0.5 * hole.bore_mm;
  double farthest = hole.mouth_mm;
  for (const double radius : {bore + demand_.wall_mm, 1.05 * bore}) {
    std::array<double, ring_points> lengths{};
    const auto ring = ring_of(hole, radius);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const auto length = way_out_mm(outer_, ring[k], hole.outward, most);
      if (!length || *length <= 0) return false;
      lengths[k] = *length;
    }
    const RimFit rim = fit(lengths, radius);
    if (rim.off_mm > uneven_ratio * bore + 0.1 * radius || rim.slope > std::tan(std::acos(least_cos))) return false;
    if (radius < bore + demand_.wall_mm) farthest = std::max(farthest, *std::ranges::max_element(lengths));
  }
  hole.end_mm = farthest + 0.5 * bore;
  for (const double radius : {0.0, 1.05 * bore})
    for (const Vec3& from : ring_of(hole, radius)) {
      if (!is_free(from + (farthest + 0.02) * hole.outward, hole.outward, 2 * bore * (radius > 0 ? 0.5 : free_ratio)))
        return false;
      if (!(radius > 0)) break;
    }
  return true;
}

bool Channels::touches_the_plate(const Hole& hole) const {
  const double radius = 0.52 * hole.bore_mm;
  std::size_t stands = 0;
  for (const Pose& pose : fences_.poses) {
    const StandingPose* standing = pose.standing();
    if (!standing) continue;
    const double least = plates_mm_[stands++] + standing->contact_height_mm + over_contact_mm;
    const double along = dot(hole.outward, standing->up);
    const double lip = radius * std::sqrt(std::max(0.0, 1 - along * along));
    const double rise = std::abs(along) * radius * std::tan(std::acos(least_cos));  // of a slanting rim
    for (const double at : {0.0, hole.mouth_mm}) {
      const Vec3 point = hole.at(at);
      const bool may_touch =
          standing->contacts.empty() || std::ranges::any_of(standing->contacts, [&](const Contact& contact) {
            return norm(point - contact.center_mm) < contact.radius_mm + 2 * hole.bore_mm;
          });
      if (may_touch && dot(point, standing->up) - lip - (at > 0 ? 0.5 * rise : 0) < least) return true;
    }
  }
  return false;
}

bool Channels::is_fenced(const Hole& hole) const {
  const double beside = 0.52 * hole.bore_mm + fence_mm;
  const auto is_near = [&](Vec3 center, double radius) {
    constexpr int steps = 8;
    for (int k = 0; k <= steps; ++k) {
      const double at = hole.throat_mm + (hole.end_mm - hole.throat_mm) * k / steps;
      if (norm(hole.at(at) - center) < radius + beside) return true;
    }
    return false;
  };
  for (const BallRegion& ball : fences_.kept)
    if (is_near(ball.center_mm, ball.radius_mm)) return true;
  for (const Pose& pose : fences_.poses)
    if (const HangingPose* hanging = pose.hanging())
      for (const Vec3& point : hanging->attachments_mm)
        if (is_near(point, demand_.wall_mm)) return true;
  return touches_the_plate(hole);
}

bool Channels::can_be_drilled(Channel& channel, std::span<const Hole> others) const {
  if (is_fenced(channel.hole) || !has_room(channel) || is_fenced(channel.hole)) return false;
  const double apart = 1.04 * channel.hole.bore_mm + demand_.wall_mm;
  return std::ranges::all_of(others, [&](const Hole& other) { return distance_between(channel.hole, other) >= apart; });
}

}  // namespace aplomb::detail
