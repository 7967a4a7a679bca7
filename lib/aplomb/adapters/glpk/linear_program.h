#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace aplomb::adapters {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Maximise objective . x over lower <= x <= upper and row_lower <= rows x (dense, any row_lower; equality where said).
struct LinearProgram {
  struct Variable {
    double objective = 0;
    double lower = 0;
    double upper = unbounded;
  };
  struct Row {
    std::vector<double> coefficients;  ///< one per variable
    double lower = 0;
    bool equality = false;
  };
  std::vector<Variable> variables;
  std::vector<Row> rows;
};

struct LinearSolution {
  double value = 0;
  std::vector<double> x;  ///< one per variable
  std::vector<double>
      duals;  ///< one per row: the value's derivative with respect to its lower bound, <= 0 for inequalities
};

/// Solves by GLPK's simplex method. Nothing when it is infeasible, unbounded or does not solve it,
/// nor where an assertion of GLPK fails or its method goes round, as on columns that are nearly the same.
/// Meant for small programs: O(rows x variables) memory.
std::optional<LinearSolution> solve(const LinearProgram& program);

}  // namespace aplomb::adapters
