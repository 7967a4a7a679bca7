#pragma once

#include <vector>

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// What a picture of stresses shows.
struct StressField {
  TriangleMesh surface;            ///< of the solid, simplified
  std::vector<double> stress_mpa;  ///< of every vertex: the largest compression or tension, whichever way it is pushed
  double measured_mpa = 0;         ///< what the check measured
};

}  // namespace aplomb
