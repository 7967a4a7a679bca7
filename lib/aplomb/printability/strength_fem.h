#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/slices.h"
#include "aplomb/printability/solid_tets.h"
#include "aplomb/printability/stress_field.h"

namespace aplomb {

struct FemOptions {
  double density_g_per_cm3 = 1.24;                  ///< > 0
  std::size_t memory_bytes = std::size_t{2} << 30;  ///< of the factors
  TetCounts tets{};
};

struct FemStrength {
  std::vector<Place> places;         ///< none or one
  std::optional<StressField> field;  ///< none where nothing was judged
  std::string why_not;               ///< it cannot be judged; empty: it was
};

/// "strength.fem": the stress that 1 mm3 of the material exceeds, MPa, under the loads of strength.ankle, by linear
/// elasticity instead of beam theory.
///
/// Every body is clamped where it lies in the first layer (and as much higher as the surface was simplified). It
/// carries its own weight, and at its top a push of 10 N in the worst of 64 directions (0.1 % off the worst of all),
/// spread over the nodes within 0.5 % of its height from the top. The stress is the largest compression or tension in
/// any direction. A volume and not a point, because at clamps, notches and sharp inner edges the point's stress grows
/// without end as tetrahedra shrink; 1 mm3 is our choice.
///
/// As with strength.ankle, what is nearer to the plate or the body's top than half a section's width does not count
/// (the clamp and the push are not as in life there), nor do chips: layers with less than 2 % of the volume above. Half
/// the width is sqrt(area / pi) of the layer's largest outline.
///
/// The stress does not depend on Young's modulus; Poisson's ratio is 0.35, and 0.2 for binder.
///
/// \pre options.density_g_per_cm3 > 0.
/// \return over_budget, third_party, cancelled. Nothing where the process does not have the check.
/// \par Cost  lib/README.md, "Strength by elasticity".
Result<FemStrength> measure_strength_fem(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                         const FemOptions& options, const Job& job = {});

}  // namespace aplomb
