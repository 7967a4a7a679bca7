#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "aplomb/core/vec.h"

namespace aplomb::detail {

/// A triangle prepared for the distances of many points.
class Facet {
 public:
  Facet(Vec3 a, Vec3 b, Vec3 c)
      : corners_{a, b, c}, area_vector_(cross(b - a, c - a)), doubled_area_(norm(area_vector_)) {
    longest_ = std::sqrt(std::max({squared_norm(b - a), squared_norm(c - b), squared_norm(a - c)}));
  }

  Vec3 area_vector() const { return area_vector_; }
  double doubled_area() const { return doubled_area_; }
  double height() const { return doubled_area_ / longest_; }
  double height_ratio() const { return doubled_area_ / (longest_ * longest_); }

  /// To be called before the distances. \pre doubled_area() > 0.
  void prepare() {
    normal_ = area_vector_ / doubled_area_;
    for (int i = 0; i < 3; ++i) inward_[i] = cross(normal_, corners_[(i + 1) % 3] - corners_[i]);
  }
  double squared_distance(Vec3 p) const {
    const double height = dot(normal_, p - corners_[0]);
    double nearest = std::numeric_limits<double>::infinity();
    bool above = true;
    for (int i = 0; i < 3; ++i) {
      const Vec3 from = p - corners_[i];
      if (dot(inward_[i], from) >= 0) continue;
      above = false;
      const Vec3 edge = corners_[(i + 1) % 3] - corners_[i];
      const double along = std::clamp(dot(from, edge) / squared_norm(edge), 0.0, 1.0);
      nearest = std::min(nearest, squared_norm(from - along * edge));
    }
    return above ? height * height : nearest;
  }

 private:
  std::array<Vec3, 3> corners_;
  Vec3 area_vector_;
  double doubled_area_, longest_ = 0;
  Vec3 normal_;
  std::array<Vec3, 3> inward_;
};

}  // namespace aplomb::detail
