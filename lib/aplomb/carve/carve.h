#pragma once

#include <string>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/carve/void_field.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/volume/solid_volume.h"

namespace aplomb {

enum class CarveAim {
  least,   ///< remove the least mass with t >= required_t
  light,   ///< remove the most mass with t >= required_t
  stable,  ///< reach the largest t
};

struct CarveOptions {
  CarveAim aim = CarveAim::least;
  double required_t = 0;         ///< tan of the tip angle asked for, or what t stands for in the problem; finite
  double least_volume_mm3 = 10;  ///< smaller voids are not carved, >= 0
};

/// A sentence that names field, value and range; empty when there is nothing to say.
std::string find_problem(const CarveOptions& options);

/// The void that was chosen and what is known of the best that could be.
struct Carving {
  VoidField field;
  AffineForm kept;                ///< the plane: kept where positive
  Moments body;                   ///< the solid less the void's polyhedron
  double t = 0;                   ///< the largest t at which every row holds for `body`
  double bound_t = 0;             ///< no void in this volume does better: certified by a dual solution
  double volume_bound_mm3 = 0;    ///< least: no void that reaches required_t is smaller; light: none is larger
  bool reaches = false;           ///< t >= required_t (to 1e-5), or nothing was required (stable)
  int planes = 0;                 ///< planes tried
  std::size_t dropped_parts = 0;  ///< voids too small to carve
  double dropped_mm3 = 0;
};

/// Chooses the void that makes every pose of the problem hold.
///
/// Maximises t (or, with t >= required_t, the volume kept or removed) over the kept share r(x) in [0, 1] of the region
/// that `volume` allows to carve, subject to, for every row i of the problem,
///
///     integral of r(x) (a_i(x) - t b_i(x)) >= 0
///
/// The optimum is a half-space: r(x) = [ l(x) > 0 ] with l affine. Prevost et al. 2013 sweep a vertical plane through
/// the target greedily; this plane is tilted and provably best. Where parts too small to carve are dropped, it is
/// solved again without them. When required_t cannot be reached, the most stable void is given and `reaches` is false.
///
/// \pre  find_problem(options) is empty; the problem has rows; `solid` are the moments of the solid that was voxelised.
/// \post No void point is nearer than the volume's wall_mm to the surface.
/// \return cancelled.
/// \par Cost  O(blocks + cut cells) a plane, 10 to 40 planes a search.
Result<Carving> carve(const SolidVolume& volume, const Moments& solid, const BalanceProblem& problem,
                      const CarveOptions& options, const Job& job = {});

/// The bound on t that carve() would certify, to a tolerance and without making a void.
Result<double> carving_bound(const SolidVolume& volume, const Moments& solid, const BalanceProblem& problem,
                             double tolerance, const Job& job = {});

}  // namespace aplomb
