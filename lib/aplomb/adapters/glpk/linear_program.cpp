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

/// GLPK ends the program where one of its own checks fails or memory runs out, unless it is jumped out of.
void jump_out(void* to) { std::longjmp(*static_cast<std::jmp_buf*>(to), 1); }

/// Nothing that it says is for our standard output.
int swallow(void*, const char*) { return 1; }

/// Calls `step(data)`, which holds nothing that wants a destructor. \return False where GLPK gave up: then all that it
/// holds in this thread is gone.
bool guarded(void (*step)(void*), void* data) {
  std::jmp_buf here;
  if (setjmp(here) != 0) {
    glp_error_hook(nullptr, nullptr);
    glp_free_env();
    return false;
  }
  glp_error_hook(jump_out, &here);
  step(data);
  glp_error_hook(nullptr, nullptr);
  return true;
}

int bounds(double lower, double upper) {
  if (lower == -unbounded) return upper == unbounded ? GLP_FR : GLP_UP;
  return upper == unbounded ? GLP_LO : GLP_DB;
}

/// What GLPK is called with and answers, in plain arrays that live outside of it.
struct Work {
  const LinearProgram& program;
  std::vector<int> indices;  // GLPK counts from 1
  std::vector<double> values;
  int method = GLP_DUALP;
  glp_prob* problem = nullptr;
  bool is_solved = false;
};

void load(Work& work) {
  const LinearProgram& program = work.program;
  glp_prob* problem = work.problem = glp_create_prob();
  const int columns = static_cast<int>(program.variables.size()), rows = static_cast<int>(program.rows.size());
  glp_set_obj_dir(problem, GLP_MAX);
  glp_add_cols(problem, columns);
  glp_add_rows(problem, rows);
  auto& indices = work.indices;
  auto& values = work.values;
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

/// GLPK's rules against cycling are not enough where columns are nearly the same: it went on for ever. A few iterations
/// a row and column is what the method takes otherwise.
int most_iterations(const LinearProgram& program) {
  return static_cast<int>(1000 + 50 * (program.rows.size() + program.variables.size()));
}

bool solved(const Work& work, double tolerance) {
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.meth = work.method;
  parameters.tol_bnd = tolerance;
  parameters.tol_dj = tolerance;
  parameters.it_lim = most_iterations(work.program);
  return glp_simplex(work.problem, &parameters) == 0 && glp_get_status(work.problem) == GLP_OPT;
}

/// Solves what is loaded; scaled, where columns are nearly the same.
void load_and_solve(void* data) {
  Work& work = *static_cast<Work*>(data);
  load(work);
  work.is_solved = solved(work, 1e-10);
  if (work.is_solved) return;
  glp_scale_prob(work.problem, GLP_SF_AUTO);
  glp_adv_basis(work.problem, 0);
  work.is_solved = solved(work, 1e-9) || solved(work, 1e-7);
}

LinearSolution solution_of(const Work& work) {
  LinearSolution solution;
  solution.value = glp_get_obj_val(work.problem);
  for (std::size_t c = 0; c < work.program.variables.size(); ++c)
    solution.x.push_back(glp_get_col_prim(work.problem, static_cast<int>(c) + 1));
  for (std::size_t r = 0; r < work.program.rows.size(); ++r)
    solution.duals.push_back(glp_get_row_dual(work.problem, static_cast<int>(r) + 1));
  return solution;
}

}  // namespace

std::optional<LinearSolution> solve(const LinearProgram& program) {
  const std::size_t entries = program.variables.size() + 1;
  for (const int method : {GLP_DUALP, GLP_PRIMAL}) {  // DUALP: the primal method where the dual one gives up
    glp_term_hook(swallow, nullptr);
    Work work{program, std::vector<int>(entries), std::vector<double>(entries), method};
    if (!guarded(load_and_solve, &work)) continue;
    const std::unique_ptr<glp_prob, Delete> problem(work.problem);
    return work.is_solved ? std::optional(solution_of(work)) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace aplomb::adapters
