#pragma once

#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// Zeroth and first moments of a body of density 1: V (mm3) and the integral of x over it (mm4).
/// Moments add: those of a shell are those of its outer surface plus those of its reversed inner ones.
struct Moments {
  double volume_mm3 = 0;
  Vec3 first_mm4;

  /// \pre volume_mm3 != 0.
  Vec3 centroid_mm() const { return first_mm4 / volume_mm3; }
  friend constexpr bool operator==(const Moments&, const Moments&) = default;
};

constexpr Moments operator+(const Moments& a, const Moments& b) {
  return {a.volume_mm3 + b.volume_mm3, a.first_mm4 + b.first_mm4};
}
constexpr Moments operator-(const Moments& a, const Moments& b) {
  return {a.volume_mm3 - b.volume_mm3, a.first_mm4 - b.first_mm4};
}
constexpr Moments operator*(double s, const Moments& a) { return {s * a.volume_mm3, s * a.first_mm4}; }
constexpr Moments& operator+=(Moments& a, const Moments& b) { return a = a + b; }

/// Moments of the region that a closed surface encloses (the divergence theorem, triangle by triangle; summed
/// about the box's centre, so that a model far from the origin loses no digits).
///
/// \pre  The mesh is closed; voids are wound the other way and count as negative volume.
Moments moments(const TriangleMesh& mesh);

}  // namespace aplomb
