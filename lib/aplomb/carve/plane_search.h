#pragma once

#include <functional>
#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"

namespace aplomb {

/// Of all bodies that carving may leave, the one with the greatest integral of the form: what lies where the form is
/// positive is kept, as much as may be of the rest is carved.
using BestBody = std::function<Moments(const AffineForm& kept)>;

/// A half-space to keep, and what is known of the best that could be.
struct PlaneChoice {
  AffineForm kept;   ///< keep where positive
  Moments body;      ///< what the half-space leaves
  double t = 0;      ///< the largest t at which every row holds for `body`
  double bound = 0;  ///< no body does better: than t (most_stable), than volume (extreme_volume, mm3)
};

enum class VolumeAim { most, least };

/// Finds the best half-space for a balance problem by column generation in the 4-space of moments.
///
/// For weights y >= 0 on the rows, the body that is best for the form  l = c + sum_i y_i (a_i - t b_i)  bounds every
/// body, and its moments are one more point of the convex set of all that carving can reach. A linear program over
/// the points found so far gives the next weights (Dantzig and Wolfe 1960); t is raised as in Dinkelbach 1967. The
/// optimum is one half-space, for l is affine (DESIGN "Carving is exact", in lib/README.md). Points found serve later
/// searches.
class PlaneSearch {
 public:
  /// \pre problem.rows is not empty. `uncarved` is one of the bodies.
  PlaneSearch(BalanceProblem problem, BestBody best_body, const Moments& uncarved);

  /// Maximises t until a half-space, or a mixture of them, is within `tolerance` of the certified bound. Where no body
  /// fulfils the rows with b = 0, which do not depend on t, both are -infinity and the body comes nearest to it.
  Result<PlaneChoice> most_stable(double tolerance, const Job& job = {});

  /// The most (or least) volume with every row at t, to 1e-8 of the uncarved volume; the half-space's own t may miss
  /// it by 1e-3, and is `feasible` itself where only bodies next to it hold the rows. \pre `feasible` holds the rows at
  /// t.
  Result<PlaneChoice> extreme_volume(VolumeAim aim, double t, const PlaneChoice& feasible, const Job& job = {});

  /// How many planes were tried so far.
  int planes() const { return planes_; }

 private:
  double row_value(const BalanceRow& row, double t, const Moments& body) const;
  AffineForm combination(const std::vector<double>& weights, double t) const;
  Moments try_plane(const AffineForm& kept);
  double least_b(const BalanceRow& row) const;
  Result<double> meet_conditions(PlaneChoice& best, const Job& job);
  double certified_bound(const std::vector<double>& weights, double t, double value) const;

  BalanceProblem problem_;
  BestBody best_body_;
  double scale_ = 1;  // mm4: makes row values about 1
  double volume_mm3_ = 1;
  std::vector<double> row_weights_;  // b of the uncarved body, scaled
  std::vector<double> least_b_;      // of any body, scaled
  std::vector<Moments> points_;
  int planes_ = 0;
};

}  // namespace aplomb
