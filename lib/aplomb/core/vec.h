#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace aplomb {

/// A point or direction in model space: millimetres, right-handed.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  constexpr double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) { return s * a; }
constexpr Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
constexpr Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
constexpr Vec3& operator-=(Vec3& a, Vec3 b) { return a = a - b; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
constexpr double squared_norm(Vec3 a) { return dot(a, a); }
inline double norm(Vec3 a) { return std::sqrt(squared_norm(a)); }
/// \pre a is not zero.
inline Vec3 normalized(Vec3 a) { return a / norm(a); }

/// A point or direction on a plane: millimetres.
struct Vec2 {
  double x = 0, y = 0;
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2 a) { return std::hypot(a.x, a.y); }

/// A 3x3 matrix by rows.
struct Mat3 {
  std::array<Vec3, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

constexpr Vec3 operator*(const Mat3& m, Vec3 v) { return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)}; }
constexpr Mat3 transposed(const Mat3& m) {
  return {{{{m.rows[0].x, m.rows[1].x, m.rows[2].x},
            {m.rows[0].y, m.rows[1].y, m.rows[2].y},
            {m.rows[0].z, m.rows[1].z, m.rows[2].z}}}};
}
constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
  const Mat3 columns = transposed(b);
  return {{{columns * a.rows[0], columns * a.rows[1], columns * a.rows[2]}}};
}
constexpr Mat3 operator*(double s, const Mat3& m) { return {{{s * m.rows[0], s * m.rows[1], s * m.rows[2]}}}; }
constexpr double determinant(const Mat3& m) { return dot(m.rows[0], cross(m.rows[1], m.rows[2])); }

/// x -> linear x + translation.
struct Affine3 {
  Mat3 linear;
  Vec3 translation;
};

constexpr Vec3 operator*(const Affine3& t, Vec3 p) { return t.linear * p + t.translation; }
/// (a * b)(p) = a(b(p)).
constexpr Affine3 operator*(const Affine3& a, const Affine3& b) {
  return {a.linear * b.linear, a.linear * b.translation + a.translation};
}

/// An axis-aligned box; empty until a point was added.
struct Box3 {
  Vec3 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
           -std::numeric_limits<double>::infinity()};

  constexpr void add(Vec3 p) {
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < min[axis]) min[axis] = p[axis];
      if (p[axis] > max[axis]) max[axis] = p[axis];
    }
  }
  constexpr bool empty() const { return !(min.x <= max.x); }
  constexpr Vec3 size() const { return empty() ? Vec3{} : max - min; }
  double diagonal() const { return norm(size()); }
};

}  // namespace aplomb
