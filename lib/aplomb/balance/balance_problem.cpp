#include "aplomb/balance/balance_problem.h"

#include <algorithm>
#include <limits>

namespace aplomb {

double largest_t(const BalanceProblem& problem, const Moments& body) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double t = infinity;
  for (const BalanceRow& row : problem.rows) {
    const double a = row.a(body), b = row.b(body);
    if (b > 0) t = std::min(t, a / b);
    else if (a < 0) t = -infinity;
  }
  return t;
}

}  // namespace aplomb
