#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "aplomb/pipeline.h"
#include "campaign/figure.h"

namespace aplomb::campaign {

/// A way to hold; attachments and directions refer to the figure by numbers in [0, 1).
struct PoseChoice {
  bool hangs = false;
  Vec3 up{0, 0, 1};
  double angle_rad = 0;      ///< asked for, or
  bool is_relative = false;  ///< by which it is to hold better than it does as it comes
  double contact_height_mm = 0.1;
  std::vector<double> vertices;  ///< one or two: hangs from there
};

/// Everything that a run of the pipeline is given.
struct Case {
  Figure figure;
  std::vector<PoseChoice> poses;
  StandOptions options;  ///< but for its poses
};

/// The case of a number: the same everywhere.
Case case_of(std::uint64_t seed);

/// The options with the poses of the case, which name points of the solid.
StandOptions options_of(const Case& a_case, const SolidMesh& solid);

/// For people who want to see why it failed.
std::string describe(const Case& a_case);

}  // namespace aplomb::campaign
