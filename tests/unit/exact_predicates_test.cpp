#include "aplomb/adapters/cgal/exact_predicates.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace aplomb::adapters {
namespace {

using Integer = __int128;
using Point = std::array<std::int64_t, 3>;

Vec3 vec(const Point& p) { return {double(p[0]), double(p[1]), double(p[2])}; }

int sign_of_determinant(const Point& a, const Point& b, const Point& c, const Point& d) {
  std::array<std::array<Integer, 3>, 3> m{};
  for (int axis = 0; axis < 3; ++axis)
    m[0][axis] = b[axis] - a[axis], m[1][axis] = c[axis] - a[axis], m[2][axis] = d[axis] - a[axis];
  Integer determinant = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    determinant += m[0][i] * (m[1][j] * m[2][k] - m[1][k] * m[2][j]);
  }
  return determinant > 0 ? 1 : determinant < 0 ? -1 : 0;
}

// Points of a plane, and beside it by the least that there is, so large that no double holds the determinant.
TEST(OrientedPlane, TellsTheSideOfIntegersAsIntegersDo) {
  std::mt19937_64 random(11);
  std::uniform_int_distribution<std::int64_t> coordinate(-(1 << 30), 1 << 30), share(-3, 3), step(-1, 1);
  std::array<int, 3> seen{};
  for (int i = 0; i < 20'000; ++i) {
    Point a{}, b{}, c{}, d{};
    const std::int64_t along_b = share(random), along_c = share(random);
    for (int axis = 0; axis < 3; ++axis) {
      a[axis] = coordinate(random), b[axis] = coordinate(random), c[axis] = coordinate(random);
      d[axis] = a[axis] + along_b * (b[axis] - a[axis]) + along_c * (c[axis] - a[axis]) + step(random);
    }
    const int side = sign_of_determinant(a, b, c, d);
    ++seen[std::size_t(side + 1)];
    const OrientedPlane plane({vec(a), vec(b), vec(c)});
    ASSERT_EQ(plane.side_of(vec(d)), side) << "case " << i;
    ASSERT_EQ(OrientedPlane({vec(b), vec(a), vec(c)}).side_of(vec(d)), -side) << "case " << i;
    for (const Point& corner : {a, b, c}) ASSERT_EQ(plane.side_of(vec(corner)), 0) << "case " << i;
  }
  for (const int count : seen) EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace aplomb::adapters
