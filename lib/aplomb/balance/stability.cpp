#include "aplomb/balance/stability.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace aplomb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double gravity_m_per_s2 = 9.80665;
constexpr double g_per_cm3_in_g_per_mm3 = 1e-3;
constexpr double newtons_per_gram = 1e-3 * gravity_m_per_s2;

double energy_to_topple_j(double weight_n, double margin_mm, double com_height_mm) {
  if (margin_mm <= 0) return 0;
  const double rise_mm = margin_mm * margin_mm / (std::hypot(margin_mm, com_height_mm) + com_height_mm);
  return weight_n * rise_mm * 1e-3;
}

/// min over edges of the angle at which the worst body within the tolerances tips: per edge the centre of
/// mass as far out, and as high (or, when it lies outside, as low), as any densities put it.
double robust_tip_angle_rad(const SupportPolygon& support, std::span<const Region> body, const StandingPose& pose) {
  const double highest_mm = farthest_centroid_mm(body, support.frame.up) - support.frame.plate_mm;
  const double lowest_mm = -farthest_centroid_mm(body, -support.frame.up) - support.frame.plate_mm;
  double tip_rad = infinity;
  for (const SupportEdge& edge : support.edges()) {
    const Vec2 outward = -1.0 * edge.inward;
    const double margin_mm =
        dot(outward, edge.from_mm) - farthest_centroid_mm(body, support.frame.direction(outward)) - pose.xy_error_mm;
    tip_rad = std::min(tip_rad, std::atan2(margin_mm, margin_mm >= 0 ? highest_mm : lowest_mm));
  }
  return tip_rad;
}

}  // namespace

double farthest_centroid_mm(std::span<const Region> body, Vec3 direction) {
  struct Part {
    double along_mm, low_mass, high_mass;
  };
  std::vector<Part> parts;
  double mass = 0, first = 0;
  for (const Region& region : body) {
    const double nominal = region.density_g_per_cm3 * region.moments.volume_mm3;
    const Part part{dot(direction, region.moments.centroid_mm()), nominal * (1 - region.density_error_ratio),
                    nominal * (1 + region.density_error_ratio)};
    mass += part.low_mass;
    first += part.low_mass * part.along_mm;
    parts.push_back(part);
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.along_mm > b.along_mm; });
  double farthest_mm = first / mass;
  for (const Part& part : parts) {  // the farthest parts at their heaviest, one more each time
    mass += part.high_mass - part.low_mass;
    first += (part.high_mass - part.low_mass) * part.along_mm;
    farthest_mm = std::max(farthest_mm, first / mass);
  }
  return farthest_mm;
}

BodyMass mass_of(std::span<const Region> body) {
  assert(!body.empty());
  BodyMass total;
  Vec3 first;
  for (const Region& region : body) {
    const double density_g_per_mm3 = region.density_g_per_cm3 * g_per_cm3_in_g_per_mm3;
    total.volume_mm3 += region.moments.volume_mm3;
    total.mass_g += density_g_per_mm3 * region.moments.volume_mm3;
    first += density_g_per_mm3 * region.moments.first_mm4;
  }
  total.com_mm = first / total.mass_g;
  return total;
}

Stability measure_stability(const SupportPolygon& support, std::span<const Region> body, const StandingPose& pose) {
  assert(!body.empty() && !support.corners_mm.empty());
  const BodyMass total = mass_of(body);
  Stability s;
  s.volume_mm3 = total.volume_mm3;
  s.mass_g = total.mass_g;
  s.com_mm = total.com_mm;
  s.com_height_mm = support.frame.height_mm(s.com_mm);
  s.can_stand = !support.degenerate();
  s.margin_mm = infinity;
  const std::vector<SupportEdge> edges = support.edges();
  const Vec2 com_on_plate = support.frame.on_plate(s.com_mm);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double margin_mm = dot(edges[i].inward, com_on_plate - edges[i].from_mm);
    if (margin_mm >= s.margin_mm) continue;
    s.margin_mm = margin_mm;
    s.weak_edge = i;
  }
  const SupportEdge& weak = edges[s.weak_edge];
  s.weak_edge_mm = {support.frame.in_model(weak.from_mm), support.frame.in_model(weak.to_mm)};
  s.heading = -support.frame.direction(weak.inward);
  s.tip_rad = std::atan2(s.margin_mm, s.com_height_mm);
  s.robust_tip_rad = robust_tip_angle_rad(support, body, pose);
  const double weight_n = s.mass_g * newtons_per_gram;
  s.topple_energy_j = energy_to_topple_j(weight_n, s.margin_mm, s.com_height_mm);
  s.push_height_mm = support.height_mm;
  s.topple_push_n = weight_n * std::max(0.0, s.margin_mm) / s.push_height_mm;
  return s;
}

Result<std::array<ContactVariant, 3>> contact_variants(const TriangleMesh& mesh, std::span<const Region> body,
                                                       const StandingPose& pose) {
  std::array<ContactVariant, 3> variants;
  StandingPose varied = pose;
  for (ContactVariant& variant : variants) {
    const Result<SupportPolygon> support = support_polygon(mesh, varied);
    if (!support) return tl::unexpected(support.error());
    variant = {varied.contact_height_mm, measure_stability(*support, body, varied).tip_rad, support->area_mm2()};
    varied.contact_height_mm *= 2;
  }
  return variants;
}

}  // namespace aplomb
