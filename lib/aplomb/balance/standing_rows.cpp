#include "aplomb/balance/standing_rows.h"

namespace aplomb {

BalanceProblem standing_rows(const SupportPolygon& support, const StandingPose& pose, RowKind kind) {
  const AffineForm height{-support.frame.plate_mm, support.frame.up};
  const double inset_mm = kind == RowKind::robust ? pose.xy_error_mm : 0;
  BalanceProblem problem;
  for (const SupportEdge& edge : support.edges())
    problem.rows.push_back(
        {{-dot(edge.inward, edge.from_mm) - inset_mm, support.frame.direction(edge.inward)}, height});
  return problem;
}

}  // namespace aplomb
