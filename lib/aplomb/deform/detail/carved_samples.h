#pragma once

#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/deform/deform_cage.h"
#include "aplomb/deform/detail/held_carving.h"
#include "aplomb/deform/detail/tet_shape.h"

namespace aplomb::detail {

/// The best carving of the solid in one position of the cage.
struct CarvedShape {
  double t = 0;     ///< the largest at which every row holds
  AffineForm kept;  ///< where positive
  std::vector<KeptShare> shares;
};

/// The solid as samples that the cage carries, each counted as a ball of its volume: a plane through it takes a cap.
/// So what a plane leaves changes smoothly with the plane and with the cage, and is exact for the balls.
class CarvedSamples {
 public:
  CarvedSamples(const CageProblem& problem, const std::vector<TetShape>& shapes);

  /// Chooses the half-space with the largest t for these vertices. \pre No tetrahedron is inverted.
  /// \return cancelled, internal.
  Result<CarvedShape> best_carving(const std::vector<Vec3>& vertices, const Job& job = {});

  /// The rows, with every b positive: one whose b is zero (it holds or does not, whatever t is) has t trade against
  /// the size of the solid instead, which changes nothing at required_t.
  const BalanceProblem& rows() const { return rows_; }
  Vec3 origin() const { return origin_; }

 private:
  void move_to(const std::vector<Vec3>& vertices);
  Moments best_body(const AffineForm& kept) const;
  std::vector<KeptShare> shares(const AffineForm& kept) const;

  const CageProblem& problem_;
  const std::vector<TetShape>& shapes_;
  BalanceProblem rows_;
  Vec3 origin_;
  std::vector<double> radius_mm_;  // of the samples that may be carved, which come first in order_
  std::vector<std::size_t> order_;
  // The samples that may be carved, where they are now:
  std::vector<double> x_, y_, z_, carvable_mm3_;
  std::vector<double> change_;  // det F of every tetrahedron
  Moments solid_;               // of all samples, about the origin
  Moments least_;               // of what cannot be carved
};

}  // namespace aplomb::detail
