#pragma once

#include <array>

#include "aplomb/core/vec.h"

namespace aplomb::detail {

/// The weighted sum of squared distances to planes, as a quadratic form (Garland and Heckbert 1997):
/// sum w (n . x - d)^2 = x^T A x - 2 b^T x + c.
class Quadric {
 public:
  Quadric() = default;
  /// \pre normal has length 1.
  Quadric(Vec3 normal, double offset, double weight)
      : a_{weight * normal.x * normal.x, weight * normal.y * normal.y, weight * normal.z * normal.z,
           weight * normal.x * normal.y, weight * normal.y * normal.z, weight * normal.z * normal.x},
        b_(weight * offset * normal),
        c_(weight * offset * offset),
        weight_(weight) {}

  Quadric& operator+=(const Quadric& q) {
    for (int i = 0; i < 6; ++i) a_[i] += q.a_[i];
    b_ += q.b_;
    c_ += q.c_;
    weight_ += q.weight_;
    return *this;
  }

  double weight() const { return weight_; }
  double operator()(Vec3 x) const {
    return x.x * (a_[0] * x.x + 2 * (a_[3] * x.y - b_.x)) + x.y * (a_[1] * x.y + 2 * (a_[4] * x.z - b_.y)) +
           x.z * (a_[2] * x.z + 2 * (a_[5] * x.x - b_.z)) + c_;
  }

 private:
  std::array<double, 6> a_{};  // xx yy zz xy yz zx
  Vec3 b_;
  double c_ = 0, weight_ = 0;
};

}  // namespace aplomb::detail
