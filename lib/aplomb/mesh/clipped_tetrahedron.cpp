#include "aplomb/mesh/clipped_tetrahedron.h"

#include <cmath>
#include <utility>

namespace aplomb {
namespace {

Moments whole(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const double volume = std::abs(dot(b - a, cross(c - a, d - a))) / 6;
  return {volume, 0.25 * volume * (a + b + c + d)};
}

}  // namespace

Moments negative_part(const std::array<Vec3, 4>& corners, const std::array<double, 4>& values) {
  std::array<int, 4> order{};  // negative corners first
  int negative = 0, positive = 3;
  for (int i = 0; i < 4; ++i) order[values[i] < 0 ? negative++ : positive--] = i;
  const auto corner = [&](int i) { return corners[order[i]]; };
  const auto zero = [&](int inside, int outside) {  // where the edge from a negative to another corner crosses zero
    const double v = values[order[inside]], w = values[order[outside]];
    return corner(inside) + (v / (v - w)) * (corner(outside) - corner(inside));
  };
  const auto all = [&] { return whole(corner(0), corner(1), corner(2), corner(3)); };
  if (negative == 0) return {};
  if (negative == 4) return all();
  if (negative == 1) return whole(corner(0), zero(0, 1), zero(0, 2), zero(0, 3));
  if (negative == 3) return all() - whole(corner(3), zero(0, 3), zero(1, 3), zero(2, 3));
  const Vec3 p = zero(0, 2), q = zero(0, 3), r = zero(1, 2), s = zero(1, 3);
  return whole(corner(0), p, q, s) + whole(corner(0), p, r, s) + whole(corner(0), corner(1), r, s);
}

Moments negative_part_of_unit_cube(const std::array<double, 8>& values) {
  // A tetrahedron per order of the axes, each from corner 0 to corner 7.
  static constexpr std::array<std::array<int, 4>, 6> tetrahedra{
      {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};
  Moments sum;
  for (const auto& tetrahedron : tetrahedra) {
    std::array<Vec3, 4> corners;
    std::array<double, 4> at_corners;
    for (int i = 0; i < 4; ++i) {
      const int c = tetrahedron[i];
      corners[i] = {double(c & 1), double(c >> 1 & 1), double(c >> 2 & 1)};
      at_corners[i] = values[c];
    }
    sum += negative_part(corners, at_corners);
  }
  return sum;
}

}  // namespace aplomb
