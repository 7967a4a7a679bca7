#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aplomb/deform/cage.h"
#include "aplomb/deform/deform_cage.h"
#include "aplomb/mesh/placement.h"

namespace aplomb {

/// What of a solid is meant: all of it that lies in a ball, or near its centre where the radius is 0.
struct BallRegion {
  Vec3 center_mm;
  double radius_mm = 0;  ///< >= 0
};

struct StiffRegion {
  BallRegion at;
  double ratio = 1;  ///< times as stiff as the rest, in [0.001, 1000]
};

/// A region that the user moves, turns or scales: translations, rotations and scalings as Prevost et al. 2013 have
/// them. The rest follows as little as it must. A region that is turned or scaled and not moved is free to go along
/// with the solid around it.
struct Handle {
  BallRegion at;
  std::optional<Vec3> to_mm{};    ///< where its centre goes
  std::vector<AxisTurn> turns{};  ///< in this order, about its centre
  double scale_ratio = 1;         ///< in [0.2, 5]
};

/// What the user wants of parts of the solid; where they overlap, what comes later here holds.
struct Regions {
  std::vector<StiffRegion> stiffened{};
  std::vector<BallRegion> kept{};  ///< which may move but keep their shape, such as a face
  std::vector<Handle> handles{};
  std::vector<BallRegion> locked{};  ///< which stay where they are
};

/// A sentence that names field, value and range; empty when there is nothing to say.
std::string find_problem(const Regions& regions);

/// Puts the regions into a problem whose rest is the cage's mesh: stiffness, wanted shapes, pulls and fixed vertices.
///
/// \pre  find_problem(regions) is empty; problem.stiffness and problem.fixed have their sizes.
/// \return invalid_option when a region holds nothing of the solid.
Result<void> mark_regions(const Cage& cage, const Regions& regions, CageProblem& problem);

/// The farthest that a pulled point is from where it was to go; 0 without any.
double farthest_pull_mm(const CageProblem& problem, const std::vector<Vec3>& vertices);

}  // namespace aplomb
