#include "aplomb/carve/plane_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "aplomb/adapters/glpk/linear_program.h"

namespace aplomb {

using adapters::LinearProgram;
using adapters::LinearSolution;

namespace {

constexpr int most_planes = 400;
constexpr double own_t_tolerance = 1e-3;  // by which the half-space of most or least volume may miss t

bool is_condition(const BalanceRow& row) { return row.b.constant == 0 && row.b.gradient == Vec3{}; }

/// Maximises the least of  form_i(mixture) / weight_i  over mixtures of the points: their shares come first, then s.
LinearProgram least_slack_program(const std::vector<Moments>& points, const std::vector<AffineForm>& forms,
                                  const std::vector<double>& weights) {
  LinearProgram program;
  program.variables.assign(points.size(), {});
  program.variables.push_back({1, -adapters::unbounded, adapters::unbounded});
  for (std::size_t i = 0; i < forms.size(); ++i) {
    LinearProgram::Row row;
    for (const Moments& point : points) row.coefficients.push_back(forms[i](point));
    row.coefficients.push_back(-weights[i]);
    program.rows.push_back(std::move(row));
  }
  LinearProgram::Row shares{std::vector<double>(points.size(), 1.0), 1, true};
  shares.coefficients.push_back(0);
  program.rows.push_back(std::move(shares));
  return program;
}

Moments mixture_of(const std::vector<Moments>& points, const LinearSolution& solution) {
  Moments mixture;
  for (std::size_t k = 0; k < points.size(); ++k) mixture += solution.x[k] * points[k];
  return mixture;
}

auto unsolved() { return fail(ErrorCode::internal, "the linear program over the planes found so far was not solved"); }

}  // namespace

PlaneSearch::PlaneSearch(BalanceProblem problem, BestBody best_body, const Moments& uncarved)
    : problem_(std::move(problem)), best_body_(std::move(best_body)), volume_mm3_(uncarved.volume_mm3) {
  assert(!problem_.rows.empty() && volume_mm3_ > 0);
  scale_ = volume_mm3_ * std::cbrt(volume_mm3_);
  for (const BalanceRow& row : problem_.rows) {
    const double weight = row.b(uncarved) / scale_;
    row_weights_.push_back(weight > 0 ? weight : 1);
    const bool is_as_before = !least_b_.empty() && row.b.constant == problem_.rows[least_b_.size() - 1].b.constant &&
                              row.b.gradient == problem_.rows[least_b_.size() - 1].b.gradient;
    least_b_.push_back(is_as_before ? least_b_.back() : least_b(row));
  }
  points_.push_back(uncarved);
}

/// Every body that counts fulfils c(r) >= 0 for a condition c, so b(r) >= (b - c)(r): where mass may lie above the
/// points that a figure hangs from, b has no useful bound of its own, but b - c is a constant.
double PlaneSearch::least_b(const BalanceRow& row) const {
  if (is_condition(row)) return 0;
  const auto least_of = [&](const AffineForm& form) { return form(best_body_(-1 * form)); };
  double least = std::max(0.0, least_of(row.b));
  for (const BalanceRow& other : problem_.rows)
    if (is_condition(other)) least = std::max(least, least_of(row.b - other.a));
  return least / scale_;
}

double PlaneSearch::row_value(const BalanceRow& row, double t, const Moments& body) const {
  return row.at(t)(body) / scale_;
}

AffineForm PlaneSearch::combination(const std::vector<double>& weights, double t) const {
  AffineForm sum;
  for (std::size_t i = 0; i < weights.size(); ++i) sum = sum + weights[i] * problem_.rows[i].at(t);
  return sum;
}

Moments PlaneSearch::try_plane(const AffineForm& kept) {
  ++planes_;
  points_.push_back(best_body_(kept));
  return points_.back();
}

/// No body holds all rows beyond this t. For a body r and the weighted rows A - t B,
/// A(r) - t' B(r) <= value - (t' - t) B(r), and B(r) is at least the sum of the weighted least_b_.
double PlaneSearch::certified_bound(const std::vector<double>& weights, double t, double value) const {
  if (value <= 0) return t;
  const double least = std::inner_product(weights.begin(), weights.end(), least_b_.begin(), 0.0);
  return least > 0 ? t + value / least : std::numeric_limits<double>::infinity();
}

/// Maximises the least slack of the conditions alone, until it is positive or proved not to be. A t that some mixture
/// of bodies holds, or -infinity.
Result<double> PlaneSearch::meet_conditions(PlaneChoice& best, const Job& job) {
  std::vector<AffineForm> conditions;
  for (const BalanceRow& row : problem_.rows)
    if (is_condition(row)) conditions.push_back((1 / scale_) * row.a);
  const std::vector<double> ones(conditions.size(), 1.0);
  const auto slack = [&](const Moments& body) {
    double least = std::numeric_limits<double>::infinity();
    for (const AffineForm& condition : conditions) least = std::min(least, condition(body));
    return least;
  };
  double reached = slack(best.body);
  for (int round = 0; round < most_planes && reached <= 0; ++round) {
    if (!job.report(0, "carve")) return cancelled();
    const auto solution = adapters::solve(least_slack_program(points_, conditions, ones));
    if (!solution) return unsolved();
    if (solution->value > 0) return largest_t(problem_, mixture_of(points_, *solution));
    AffineForm kept;
    for (std::size_t i = 0; i < conditions.size(); ++i)
      kept = kept + std::max(0.0, -solution->duals[i]) * conditions[i];
    const Moments body = try_plane(kept);
    if (slack(body) > reached) best.kept = kept, best.body = body, reached = slack(body);
    if (const double most = kept(body); most <= 0 || most - solution->value < 1e-12) break;
  }
  return largest_t(problem_, best.body);
}

Result<PlaneChoice> PlaneSearch::most_stable(double tolerance, const Job& job) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PlaneChoice best{{1, {}}, points_.front(), -infinity, infinity};
  const auto start = meet_conditions(best, job);
  if (!start) return tl::unexpected(start.error());
  best.t = largest_t(problem_, best.body);
  double t = *start;
  if (!std::isfinite(t)) return best.bound = t, best;
  double mixed = t;  // reached by a mixture
  for (int round = 0; round < most_planes && best.bound - std::max(best.t, mixed) > tolerance; ++round) {
    if (!job.report(double(round) / (round + 20), "carve")) return cancelled();
    std::vector<AffineForm> forms;
    for (const BalanceRow& row : problem_.rows) forms.push_back((1 / scale_) * row.at(t));
    const auto solution = adapters::solve(least_slack_program(points_, forms, row_weights_));
    if (!solution) return unsolved();
    std::vector<double> weights(problem_.rows.size());
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = std::max(0.0, -solution->duals[i]);
    const double promised = largest_t(problem_, mixture_of(points_, *solution));
    const AffineForm kept = combination(weights, t);
    const Moments body = try_plane(kept);
    if (const double reached = largest_t(problem_, body); reached > best.t)
      best.kept = kept, best.body = body, best.t = reached;
    best.bound = std::min(best.bound, certified_bound(weights, t, kept(body) / scale_));
    mixed = std::max(mixed, promised);
    t = solution->value >= 0 && std::isfinite(promised) ? std::max(t, promised) : t + solution->value;
    t = std::min(t, best.bound);
  }
  if (best.bound - best.t <= tolerance || !(mixed > best.t)) return best;
  // Mixtures alone reach it: the form is nowhere but zero (a figure that hangs and is balanced already by many bodies).
  // Of these bodies the one with the most volume is a half-space again.
  auto balanced = extreme_volume(VolumeAim::most, mixed - 20 * tolerance, best, job);
  if (!balanced) return balanced;
  if (balanced->t > best.t) best = {balanced->kept, balanced->body, balanced->t, best.bound};
  return best;
}

Result<PlaneChoice> PlaneSearch::extreme_volume(VolumeAim aim, double t, const PlaneChoice& feasible, const Job& job) {
  const double sign = aim == VolumeAim::most ? 1 : -1;
  points_.push_back(feasible.body);
  PlaneChoice best = feasible;
  best.bound = aim == VolumeAim::most ? volume_mm3_ : 0;
  double bound = std::numeric_limits<double>::infinity();  // of sign * volume, scaled
  for (int round = 0; round < most_planes; ++round) {
    if (!job.report(double(round) / (round + 20), "carve")) return cancelled();
    LinearProgram program;  // maximise sign * volume of a mixture that holds every row
    for (const Moments& point : points_) program.variables.push_back({sign * point.volume_mm3 / volume_mm3_});
    for (const BalanceRow& balance : problem_.rows) {
      LinearProgram::Row row;
      for (const Moments& point : points_) row.coefficients.push_back(row_value(balance, t, point));
      program.rows.push_back(std::move(row));
    }
    program.rows.push_back({std::vector<double>(points_.size(), 1.0), 1, true});
    const auto solution = adapters::solve(program);
    if (!solution) break;  // what is left is too thin for the simplex method: choice and bound so far hold
    std::vector<double> weights(problem_.rows.size());
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = std::max(0.0, -solution->duals[i]) / scale_;
    const AffineForm kept = AffineForm{sign / volume_mm3_, {}} + combination(weights, t);
    const Moments body = try_plane(kept);
    bound = std::min(bound, kept(body));
    const double own_t = largest_t(problem_, body);
    best.bound = sign * bound * volume_mm3_;
    if (own_t >= t - own_t_tolerance) best = {kept, body, own_t, best.bound};
    if (bound - solution->value < 1e-8) break;
  }
  return best;
}

}  // namespace aplomb
