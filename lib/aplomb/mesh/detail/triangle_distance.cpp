#include "aplomb/mesh/detail/triangle_distance.h"

#include <algorithm>

namespace aplomb::detail {
namespace {

double squared_distance(Vec3 p, const TrianglePoints& t) {
  const Vec3 weights = closest_barycentric(p, t);
  return squared_norm(p - (weights.x * t[0] + weights.y * t[1] + weights.z * t[2]));
}

/// Between segments a + s u and b + t v, s and t in [0, 1] (Ericson, 5.1.9).
double segments_squared_distance(Vec3 a, Vec3 u, Vec3 b, Vec3 v) {
  const Vec3 r = a - b;
  const double uu = squared_norm(u), vv = squared_norm(v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  const double denominator = uu * vv - uv * uv;
  double s = denominator > 0 ? std::clamp((uv * vr - ur * vv) / denominator, 0.0, 1.0) : 0.0;
  const double t = std::clamp((uv * s + vr) / vv, 0.0, 1.0);
  s = std::clamp((uv * t - ur) / uu, 0.0, 1.0);
  return squared_norm(r + s * u - t * v);
}

bool segment_pierces(Vec3 from, Vec3 to, const TrianglePoints& t) {
  const Vec3 along = to - from;
  const auto side = [](Vec3 a, Vec3 b, Vec3 c, Vec3 d) { return dot(cross(b - a, c - a), d - a); };
  if ((side(t[0], t[1], t[2], from) > 0) == (side(t[0], t[1], t[2], to) > 0)) return false;
  const auto turn = [&](Vec3 a, Vec3 b) { return dot(along, cross(a - from, b - from)); };
  const double a = turn(t[0], t[1]), b = turn(t[1], t[2]), c = turn(t[2], t[0]);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

}  // namespace

Vec3 closest_barycentric(Vec3 p, const TrianglePoints& triangle) {
  const auto& [a, b, c] = triangle;
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

double squared_distance(const TrianglePoints& a, const TrianglePoints& b) {
  double least = squared_distance(a[0], b);
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    if (segment_pierces(a[i], a[next], b) || segment_pierces(b[i], b[next], a)) return 0;
    least = std::min({least, squared_distance(a[i], b), squared_distance(b[i], a)});
    for (int j = 0; j < 3; ++j)
      least = std::min(least, segments_squared_distance(a[i], a[next] - a[i], b[j], b[(j + 1) % 3] - b[j]));
  }
  return least;
}

}  // namespace aplomb::detail
