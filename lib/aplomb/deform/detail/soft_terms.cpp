#include "aplomb/deform/detail/soft_terms.h"

#include <algorithm>

namespace aplomb::detail {
namespace {

constexpr double noticed_mm = 1e-3;  // what a step may sink unforeseen

}  // namespace

Ground::Ground(const GroundPlane& plane, double weight, const std::vector<Vec3>& rest,
               const std::vector<double>& size_mm)
    : up_(plane.up), foreseen_(rest.size()) {
  for (std::size_t v = 0; v < rest.size(); ++v) {
    floor_mm_.push_back(std::min(plane.plate_mm, dot(up_, rest[v])));
    stiffness_.push_back(weight * size_mm[v]);
  }
}

double Ground::value(const std::vector<Vec3>& vertices) const {
  double sum = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double depth = depth_mm(v, vertices[v]);
    if (depth > 0) sum += stiffness_[v] / 2 * depth * depth;
  }
  return sum;
}

void Ground::add_gradient(const std::vector<Vec3>& vertices, std::vector<Vec3>& sum) const {
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double depth = depth_mm(v, vertices[v]);
    if (depth > 0) sum[v] += -stiffness_[v] * depth * up_;
  }
}

void Ground::add_foreseen_gradient(const std::vector<Vec3>& vertices, std::vector<Vec3>& sum) const {
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double depth = depth_mm(v, vertices[v]);
    if (depth > 0 || foreseen_[v]) sum[v] += -stiffness_[v] * depth * up_;
  }
}

bool Ground::foresee(const std::vector<Vec3>& now, const std::vector<Vec3>& next) {
  bool found = false;
  for (std::size_t v = 0; v < now.size(); ++v) {
    if (foreseen_[v] || depth_mm(v, now[v]) > 0 || depth_mm(v, next[v]) <= noticed_mm) continue;
    foreseen_[v] = true;
    found = true;
  }
  return found;
}

Vec3 HandleTerm::miss_mm(const std::vector<Vec3>& vertices) const {
  Vec3 miss = -target_mm;
  for (std::size_t k = 0; k < 4; ++k) miss += weights[k] * vertices[corners[k]];
  return miss;
}

double HandleTerm::value(const std::vector<Vec3>& vertices) const {
  return stiffness_mm / 2 * squared_norm(miss_mm(vertices));
}

void HandleTerm::add_gradient(const std::vector<Vec3>& vertices, std::vector<Vec3>& sum) const {
  const Vec3 pull = stiffness_mm * miss_mm(vertices);
  for (std::size_t k = 0; k < 4; ++k) sum[corners[k]] += weights[k] * pull;
}

}  // namespace aplomb::detail
