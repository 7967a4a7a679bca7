#pragma once

#include "aplomb/balance/balance_problem.h"
#include "aplomb/carve/carve.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/fdm/layered_print.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

struct BallastOptions {
  CarveAim aim = CarveAim::least;  ///< stable: the largest t; the others: the least mass with t >= required_t
  double required_t = 0;           ///< as CarveOptions has it
  double infill_ratio = 1;         ///< of the dense side; above the profile's, at most 1
};

/// The infill that was chosen and what is known of the best that could be.
struct Ballast {
  DenseInfill infill;
  PredictedPrint print;  ///< with it
  double t = 0;          ///< the largest t at which every row holds for `print`
  /// No filling between the two densities does better, to first order (LayeredPrint::added_by): by a dual solution.
  double bound_t = 0;
  bool reaches = false;  ///< t >= required_t, or nothing was required (stable)
  double added_mm3 = 0;  ///< of material, to the same print without it
  int planes = 0;        ///< planes tried
};

/// Chooses which side of a plane to fill densely, so that every pose of the problem holds.
///
/// The mathematics is carve()'s, with the infill between two densities instead of the solid between 0 and 1: for
/// weights y >= 0 on the rows the best filling is dense where l = sum_i y_i (a_i - t b_i) is positive and sparse
/// elsewhere, and l is affine. The sums run over the layers' own polygons, cut exactly. What bridges and filled slivers
/// cost is asked for in addition.
///
/// \pre  the problem has rows; print.profile().infill_ratio < options.infill_ratio <= 1; required_t is finite.
/// \return cancelled, third_party.
/// \par Cost  10 to 40 planes a search, each linear in the corners of the layers.
Result<Ballast> choose_ballast(const LayeredPrint& print, const BalanceProblem& problem, const BallastOptions& options,
                               const Job& job = {});

/// The part of a box where the form is positive: a closed convex surface, for slicers to take as a modifier volume;
/// without triangles where there is no such part.
TriangleMesh part_of_box(const Box3& box, const AffineForm& form);

}  // namespace aplomb
