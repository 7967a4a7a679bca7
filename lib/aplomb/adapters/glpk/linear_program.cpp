#include "aplomb/adapters/glpk/linear_program.h"

#include <glpk.h>

#include <algorithm>
#include <csetjmp>
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

/// Ends the simplex method where an assertion of GLPK fails, which else ends the process.
void leave(void* ended) { std::longjmp(*static_cast<std::jmp_buf*>(ended), 1); }

int say_nothing(void*, const char*) { return 1; }

enum class Ended { solved, unsolved, failed };

/// One try. Where it failed, GLPK's whole environment is gone, and the problem with it. Nothing here has a destructor.
Ended tried(glp_prob* problem, const glp_smcp& parameters) {
  std::jmp_buf failed;
  if (setjmp(failed) != 0) {
    glp_free_env();
    return Ended::failed;
  }
  glp_error_hook(leave, &failed);
  const bool is_solved = glp_simplex(problem, &parameters) == 0 && glp_get_status(problem) == GLP_OPT;
  glp_error_hook(nullptr, nullptr);
  return is_solved ? Ended::solved : Ended::unsolved;
}

Ended solved(glp_prob* problem, int method) {
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.meth = method;
  auto ended = Ended::unsolved;
  for (const double tolerance : {1e-10, 1e-9, 1e-7}) {
    parameters.tol_bnd = tolerance;
    parameters.tol_dj = tolerance;
    ended = tried(problem, parameters);
    if (ended != Ended::unsolved) break;
    if (tolerance > 1e-10) continue;
    glp_scale_prob(problem, GLP_SF_AUTO);  // columns that are nearly the same, mostly
    glp_adv_basis(problem, 0);
  }
  return ended;
}

LinearSolution solution_of(glp_prob* problem, const LinearProgram& program) {
  LinearSolution solution;
  solution.value = glp_get_obj_val(problem);
  for (std::size_t c = 0; c < program.variables.size(); ++c)
    solution.x.push_back(glp_get_col_prim(problem, static_cast<int>(c) + 1));
  for (std::size_t r = 0; r < program.rows.size(); ++r)
    solution.duals.push_back(glp_get_row_dual(problem, static_cast<int>(r) + 1));
  return solution;
}

}  // namespace

std::optional<LinearSolution> solve(const LinearProgram& program) {
  for (const int method : {GLP_DUALP, GLP_PRIMAL}) {  // DUALP: the primal method where the dual one gives up
    glp_term_out(GLP_OFF);
    glp_term_hook(say_nothing, nullptr);  // of assertions, too
    std::unique_ptr<glp_prob, Delete> problem(glp_create_prob());
    load(problem.get(), program);
    const Ended ended = solved(problem.get(), method);
    if (ended == Ended::solved) return solution_of(problem.get(), program);
    if (ended == Ended::unsolved) return std::nullopt;
    static_cast<void>(problem.release());
  }
  return std::nullopt;
}

}  // namespace aplomb::adapters
