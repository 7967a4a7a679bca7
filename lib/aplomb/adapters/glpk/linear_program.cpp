#include "aplomb/adapters/glpk/linear_program.h"

#include <glpk.h>

#include <algorithm>
#include <memory>

namespace aplomb::adapters {
namespace {

struct Delete {
  void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
};

int bounds(double lower, double upper) {
  if (lower == -unbounded) return upper == unbounded ? GLP_FR : GLP_UP;
  return upper == unbounded ? GLP_LO : GLP_DB;
}

void load(glp_prob* problem, const LinearProgram& program) {
  const int columns = static_cast<int>(program.variables.size()), rows = static_cast<int>(program.rows.size());
  glp_set_obj_dir(problem, GLP_MAX);
  glp_add_cols(problem, columns);
  glp_add_rows(problem, rows);
  std::vector<int> indices(columns + 1);  // GLPK counts from 1
  std::vector<double> values(columns + 1);
  for (int c = 1; c <= columns; ++c) {
    const LinearProgram::Variable& variable = program.variables[c - 1];
    glp_set_obj_coef(problem, c, variable.objective);
    glp_set_col_bnds(problem, c, bounds(variable.lower, variable.upper), variable.lower, variable.upper);
    indices[c] = c;
  }
  for (int r = 1; r <= rows; ++r) {
    const LinearProgram::Row& row = program.rows[r - 1];
    glp_set_row_bnds(problem, r, row.equality ? GLP_FX : GLP_LO, row.lower, row.lower);
    std::copy(row.coefficients.begin(), row.coefficients.end(), values.begin() + 1);
    glp_set_mat_row(problem, r, columns, indices.data(), values.data());
  }
}

bool solved(glp_prob* problem, double tolerance) {
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.meth = GLP_DUALP;  // the primal method where the dual one gives up
  parameters.tol_bnd = tolerance;
  parameters.tol_dj = tolerance;
  return glp_simplex(problem, &parameters) == 0 && glp_get_status(problem) == GLP_OPT;
}

}  // namespace

std::optional<LinearSolution> solve(const LinearProgram& program) {
  glp_term_out(GLP_OFF);
  const std::unique_ptr<glp_prob, Delete> problem(glp_create_prob());
  load(problem.get(), program);
  if (!solved(problem.get(), 1e-10)) {  // columns that are nearly the same, mostly
    glp_scale_prob(problem.get(), GLP_SF_AUTO);
    glp_adv_basis(problem.get(), 0);
    if (!solved(problem.get(), 1e-9) && !solved(problem.get(), 1e-7)) return std::nullopt;
  }
  LinearSolution solution;
  solution.value = glp_get_obj_val(problem.get());
  for (std::size_t c = 0; c < program.variables.size(); ++c)
    solution.x.push_back(glp_get_col_prim(problem.get(), static_cast<int>(c) + 1));
  for (std::size_t r = 0; r < program.rows.size(); ++r)
    solution.duals.push_back(glp_get_row_dual(problem.get(), static_cast<int>(r) + 1));
  return solution;
}

}  // namespace aplomb::adapters
