#pragma once

#include <array>
#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/deform/deform_cage.h"

namespace aplomb::detail {

/// What sinking below a plate costs: sum over vertices of  weight h_v / 2 max(0, floor_v - up . v)^2,  h_v the vertex's
/// size (the cube root of its share of the cage's volume) and floor_v the plate, or its height at rest if lower.
/// Its curvature jumps at the floor, so a step must know which vertices it will press against it: foresee() tells.
class Ground {
 public:
  Ground(const GroundPlane& plane, double weight, const std::vector<Vec3>& rest, const std::vector<double>& size_mm);

  double value(const std::vector<Vec3>& vertices) const;
  void add_gradient(const std::vector<Vec3>& vertices, std::vector<Vec3>& sum) const;
  /// The same, a foreseen vertex counting as if it were held to the floor from both sides.
  void add_foreseen_gradient(const std::vector<Vec3>& vertices, std::vector<Vec3>& sum) const;
  /// The second derivative along up of one vertex's term (foreseen ones included); it has no other.
  double curvature(std::size_t vertex, Vec3 at) const {
    return foreseen_[vertex] || depth_mm(vertex, at) > 0 ? stiffness_[vertex] : 0;
  }

  /// Foresees what the next position puts below the floor, in addition. True: something new.
  bool foresee(const std::vector<Vec3>& now, const std::vector<Vec3>& next);
  void forget() { foreseen_.assign(foreseen_.size(), false); }
  Vec3 up() const { return up_; }

 private:
  double depth_mm(std::size_t vertex, Vec3 at) const { return floor_mm_[vertex] - dot(up_, at); }

  Vec3 up_;
  std::vector<double> floor_mm_;
  std::vector<double> stiffness_;  // mm: energy (mm3) per mm2
  std::vector<bool> foreseen_;
};

/// What missing its target costs a handle:  stiffness / 2 |sum_k w_k v_k - target|^2.
struct HandleTerm {
  TetMesh::Tet corners{};
  std::array<double, 4> weights{};
  Vec3 target_mm;
  double stiffness_mm = 0;

  Vec3 miss_mm(const std::vector<Vec3>& vertices) const;
  double value(const std::vector<Vec3>& vertices) const;
  void add_gradient(const std::vector<Vec3>& vertices, std::vector<Vec3>& sum) const;
};

}  // namespace aplomb::detail
