#pragma once

#include <vector>

#include "aplomb/balance/stability.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/fdm/print_profile.h"
#include "aplomb/printability/printed_solid.h"

namespace aplomb {

/// What a slicer would lay down for a solid: volumes of material, not of space.
struct PredictedPrint {
  Moments walls, solid_infill, sparse_infill;

  Moments all() const { return walls + solid_infill + sparse_infill; }
  /// As a body of a filament; without the parts that are empty.
  std::vector<Region> body(double density_g_per_cm3) const;
};

/// Predicts the print layer by layer, from the exact polygons S_k of the slices.
///
/// Walls are the ring of S_k down to the depth D of its perimeters, the core I_k what lies deeper, less the infill's
/// overlap. Of the core the slicer fills solid, with n layers of top (and likewise bottom) skin,
///
///     I_k less the intersection of X_i over k < i < k + n, and of S_{k+n}
///
/// X_i being the cores I_i where shells keep their thickness (PrusaSlicer's ensure_vertical_shell_thickness, and Cura):
/// that is what fills sloped skins; else the slices S_i, and what is narrower than six beads grows by three. Cores
/// under solid_below_mm2 are solid, bridges are as thick as the nozzle; the rest holds its infill and links along half
/// its rim.
///
/// \pre  find_problem(profile) is empty; the solid stands on the plate, up is +z.
/// \return as cut_slices(), third_party.
/// \par Cost  O(layers n) set operations on polygons.
Result<PredictedPrint> predict_print(const PrintedSolid& printed, const PrintProfile& profile, const Job& job = {});

}  // namespace aplomb
