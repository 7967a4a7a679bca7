#include "aplomb/adapters/cgal/exact_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <tuple>
#include <utility>

namespace aplomb::adapters {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }
Kernel::Triangle_3 triangle(const Corners& c) { return {point(c[0]), point(c[1]), point(c[2])}; }

}  // namespace

OrientedPlane::OrientedPlane(const Corners& corners) : corners_(corners) {
  const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const auto minor = [](double p, double q) { return std::pair(p - q, std::abs(p) + std::abs(q)); };
  std::tie(normal_.x, permanent_.x) = minor(u.y * v.z, u.z * v.y);
  std::tie(normal_.y, permanent_.y) = minor(u.z * v.x, u.x * v.z);
  std::tie(normal_.z, permanent_.z) = minor(u.x * v.y, u.y * v.x);
}

int OrientedPlane::side_of(Vec3 d) const {
  // Shewchuk's static filter (1997): the determinant's rounding error is below (7 + 56 eps) eps times the permanent.
  const Vec3 w = d - corners_[0];
  const double determinant = dot(w, normal_);
  const double permanent = std::abs(w.x) * permanent_.x + std::abs(w.y) * permanent_.y + std::abs(w.z) * permanent_.z;
  const double bound = 7.7715611723761027e-16 * permanent;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  if (permanent == 0) return 0;  // as on a plane along the axes
  return static_cast<int>(CGAL::orientation(point(corners_[0]), point(corners_[1]), point(corners_[2]), point(d)));
}

bool triangles_meet(const Corners& a, const Corners& b) { return CGAL::do_intersect(triangle(a), triangle(b)); }

bool triangle_meets_segment(const Corners& a, Vec3 from, Vec3 to) {
  return CGAL::do_intersect(triangle(a), Kernel::Segment_3(point(from), point(to)));
}

bool on_same_side(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return CGAL::coplanar_orientation(point(a), point(b), point(c), point(d)) == CGAL::POSITIVE;
}

bool are_collinear(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 u = b - a, v = c - a;
  // Far from collinear: each component of the cross product is wrong by less than 4 eps of its terms.
  const Vec3 normal = cross(u, v);
  const auto certain = [](double value, double p, double q) {
    return std::abs(value) > 1e-15 * (std::abs(p) + std::abs(q));
  };
  if (certain(normal.x, u.y * v.z, u.z * v.y) || certain(normal.y, u.z * v.x, u.x * v.z) ||
      certain(normal.z, u.x * v.y, u.y * v.x))
    return false;
  return CGAL::collinear(point(a), point(b), point(c));
}

int orientation_xy(Vec3 a, Vec3 b, Vec3 c) {
  return static_cast<int>(
      CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y), Kernel::Point_2(c.x, c.y)));
}

}  // namespace aplomb::adapters
