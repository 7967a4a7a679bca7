#include "aplomb/deform/deform_cage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "aplomb/deform/detail/cage_energy.h"
#include "aplomb/deform/detail/carved_samples.h"
#include "aplomb/deform/detail/newton_model.h"
#include "aplomb/deform/detail/shape_change.h"
#include "aplomb/deform/detail/step_limits.h"

namespace aplomb {

using namespace detail;

namespace {

constexpr double t_margin = 1e-6;         // aimed at beyond required_t, so that the end is not short of it by rounding
constexpr double enough_decrease = 1e-4;  // of what the model promises (Armijo)
constexpr double enough_gain = 3e-4;      // of the merit: a step that promises less is the last
constexpr int most_halvings = 12;
constexpr int most_trials = 4;  // of a step that runs into the ground
constexpr int patience = 6;     // steps that may gain nothing

std::vector<double> solid_weights(const CageProblem& problem, const std::vector<TetShape>& shapes) {
  std::vector<double> weights;
  for (std::size_t t = 0; t < shapes.size(); ++t) weights.push_back(problem.solid_share[t] * shapes[t].volume_mm3);
  return weights;
}

std::vector<Vec3> moved(const std::vector<Vec3>& vertices, double s, const std::vector<Vec3>& step) {
  std::vector<Vec3> result = vertices;
  for (std::size_t v = 0; v < result.size(); ++v) result[v] += s * step[v];
  return result;
}

double longest_mm(const std::vector<Vec3>& step) {
  double most = 0;
  for (const Vec3& d : step) most = std::max(most, norm(d));
  return most;
}

double inner(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += dot(a[v], b[v]);
  return sum;
}

/// One position of the cage and what is known of it.
struct Iterate {
  std::vector<Vec3> vertices;
  double energy = 0;
  CarvedShape carved;
};

class CageDeformer {
 public:
  CageDeformer(const CageProblem& problem, const DeformOptions& options, const DeformListener& listener)
      : problem_(problem),
        options_(options),
        listener_(listener),
        shapes_(tet_shapes(problem.rest)),
        weights_(solid_weights(problem, shapes_)),
        energy_(problem, options, shapes_),
        samples_(problem, shapes_),
        goal_(problem.required_t + t_margin) {}

  Result<CageDeformation> run(const Job& job) {
    const std::vector<Vec3>& start = problem_.start.empty() ? problem_.rest.vertices : problem_.start;
    auto carved = samples_.best_carving(start);
    if (!carved) return tl::unexpected(carved.error());
    now_ = {start, energy_.value(start), std::move(*carved)};
    if (energy_.free().unknowns() == 0) return result(false);
    auto factors = adapters::SparseCholesky::analyse(energy_.hessian(now_.vertices));
    if (!factors) return tl::unexpected(factors.error());
    for (int idle = 0; iterations_ < options_.most_iterations && idle < patience; ++iterations_) {
      if (!job.report(double(iterations_) / (iterations_ + 10), "deform")) return cancelled();
      const auto step = newton_step(*factors);
      if (!step) return tl::unexpected(step.error());
      auto next = search(*step, *factors);
      if (!next) return tl::unexpected(next.error());
      if (!*next) break;
      const double before = merit(now_), t_before = now_.carved.t;
      now_ = std::move(**next);
      if (listener_) listener_(now_.vertices, now_.carved.t);
      if (settled(*step, t_before)) {
        ++iterations_;
        break;
      }
      const bool gained = before - merit(now_) > enough_gain * before;
      idle = gained ? 0 : idle + 1;
    }
    if (!job.report(1, "deform")) return cancelled();
    return result(true);
  }

 private:
  double missing(double t) const { return std::max(0.0, goal_ - t); }
  double merit(const Iterate& at) const { return at.energy + penalty_ * missing(at.carved.t); }
  double mean_mm(const std::vector<Vec3>& vertices) const {
    return mean_displacement_mm(problem_.rest, weights_, vertices);
  }
  bool reached() const { return now_.carved.t >= problem_.required_t; }
  bool settled(const NewtonStep& step, double t_before) const {
    const bool small = longest_mm(step.displacement) <= options_.settled_mm || -promised_ < enough_gain * now_.energy;
    return small && (reached() || (limited_ && now_.carved.t - t_before < 1e-5));
  }

  NewtonModel model(const adapters::SparseCholesky& factors, const Iterate& at,
                    const std::vector<Vec3>& gradient) const {
    const auto& shares = at.carved.shares;
    const Vec3 origin = samples_.origin();
    return {factors, energy_.free(), gradient, held_moments(problem_.rest, shapes_, shares, at.vertices, origin),
            moment_gradients(problem_.rest, shapes_, shares, at.vertices, origin)};
  }

  bool within_limit(const std::vector<Vec3>& step, double s = 1) const {
    return mean_mm(moved(now_.vertices, s, step)) <= options_.most_mean_mm;
  }

  /// The step of this iterate, tried again while it runs into the ground.
  Result<NewtonStep> newton_step(adapters::SparseCholesky& factors) {
    energy_.forget();
    for (int trial = 1;; ++trial) {
      auto step = step_of_model(factors);
      if (!step) return step;
      if (trial > 1 && leads_nowhere(*step)) {  // what was foreseen presses so hard that nothing else can move
        energy_.forget();
        return step_of_model(factors);
      }
      if (trial == most_trials || !energy_.foresee(now_.vertices, moved(now_.vertices, 1, step->displacement)))
        return step;
    }
  }

  Result<NewtonStep> step_of_model(adapters::SparseCholesky& factors) {
    if (!factors.factorise(energy_.hessian(now_.vertices)))
      return fail(ErrorCode::third_party, "the system of the deformation could not be factorised");
    return choose_step(model(factors, now_, energy_.model_gradient(now_.vertices)));
  }

  /// Neither less energy nor more of t.
  bool leads_nowhere(const NewtonStep& step) const {
    return inner(energy_.gradient(now_.vertices), step.displacement) >= 0 && step.t <= now_.carved.t + 1e-9;
  }

  /// The step towards as much of the goal as the limits allow; shorter than asked only where even keeping t is too far.
  NewtonStep choose_step(const NewtonModel& model) {
    const auto short_enough = [&](const NewtonStep& step) {
      return longest_mm(step.displacement) <= options_.most_step_mm;
    };
    limited_ = false;
    NewtonStep best = model.step(samples_.rows(), goal_);
    if (short_enough(best) && within_limit(best.displacement)) return best;
    limited_ = short_enough(best);
    double low = std::min(now_.carved.t, goal_), high = goal_;
    best = model.step(samples_.rows(), low);
    if (!short_enough(best) || !within_limit(best.displacement)) return shortened(std::move(best));
    for (int halving = 0; halving < 30 && high - low > 1e-9; ++halving) {
      const double middle = (low + high) / 2;
      NewtonStep tried = model.step(samples_.rows(), middle);
      const bool in_reach = short_enough(tried);
      if (in_reach && within_limit(tried.displacement)) {
        low = middle;
        best = std::move(tried);
      } else {
        limited_ = in_reach;
        high = middle;
      }
    }
    return best;
  }

  NewtonStep shortened(NewtonStep step) {
    double s = std::min(1.0, options_.most_step_mm / longest_mm(step.displacement));
    if (!within_limit(step.displacement, s)) {
      limited_ = true;
      double low = 0;
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = (low + s) / 2;
        (within_limit(step.displacement, middle) ? low : s) = middle;
      }
      s = low;
    }
    for (Vec3& d : step.displacement) d = s * d;
    return step;
  }

  /// Nothing when its energy is not below `most_energy`, and therefore no carving helps.
  Result<std::optional<Iterate>> evaluate(std::vector<Vec3> vertices, double most_energy) {
    Iterate next{std::move(vertices), 0, {}};
    next.energy = energy_.value(next.vertices);
    if (!(next.energy <= most_energy)) return std::optional<Iterate>{};
    auto carved = samples_.best_carving(next.vertices);
    if (!carved) return tl::unexpected(carved.error());
    next.carved = std::move(*carved);
    return std::optional(std::move(next));
  }

  /// The rows bend while the step is straight: what it is short of t for that reason, the least further step makes up
  /// for (the second-order correction, which spares the search its small steps: Maratos 1978).
  Result<std::optional<Iterate>> corrected(const Iterate& at, double t, const adapters::SparseCholesky& factors,
                                           double most_energy) {
    const NewtonStep step = model(factors, at, std::vector<Vec3>(at.vertices.size())).step(samples_.rows(), t);
    if (longest_mm(step.displacement) > options_.most_step_mm / 4) return std::optional<Iterate>{};
    std::vector<Vec3> vertices = moved(at.vertices, 1, step.displacement);
    if (mean_mm(vertices) > options_.most_mean_mm) return std::optional<Iterate>{};
    if (step_without_inversion(problem_.rest, shapes_, at.vertices, step.displacement) < 1)
      return std::optional<Iterate>{};
    return evaluate(std::move(vertices), most_energy);
  }

  /// Backtracks until the merit falls by enough; nothing when it does not.
  Result<std::optional<Iterate>> search(const NewtonStep& step, const adapters::SparseCholesky& factors) {
    penalty_ = std::max(penalty_, 1.5 * step.price);
    promised_ = std::min(0.0, inner(energy_.gradient(now_.vertices), step.displacement) -
                                  penalty_ * (missing(now_.carved.t) - missing(step.t)));
    const double before = merit(now_);
    const double reach = step_without_inversion(problem_.rest, shapes_, now_.vertices, step.displacement);
    double s = reach < 1 ? 0.9 * reach : 1;
    for (int halving = 0; halving < most_halvings; ++halving, s /= 2) {
      const double most = before + enough_decrease * s * promised_;
      auto next = evaluate(moved(now_.vertices, s, step.displacement), most);
      if (!next) return next;
      if (!*next) continue;
      const double aim = now_.carved.t + s * (step.t - now_.carved.t);
      if ((*next)->carved.t < aim) {
        auto better = corrected(**next, aim, factors, most);
        if (!better) return better;
        if (*better && merit(**better) < merit(**next)) next = std::move(better);
      }
      if (merit(**next) <= most) return next;
    }
    return std::optional<Iterate>{};
  }

  CageDeformation result(bool moved) const {
    CageDeformation result;
    result.vertices = now_.vertices;
    result.t = now_.carved.t;
    const AffineForm& kept = now_.carved.kept;
    result.kept = {kept.constant - dot(kept.gradient, samples_.origin()), kept.gradient};
    result.iterations = iterations_;
    result.energy_mm3 = now_.energy;
    result.mean_mm = mean_mm(now_.vertices);
    const bool at_limit = moved && result.mean_mm >= 0.99 * options_.most_mean_mm;
    result.outcome = reached() ? DeformOutcome::reached : at_limit ? DeformOutcome::limit : DeformOutcome::stuck;
    result.max_mm = max_displacement_mm(problem_.rest, now_.vertices);
    result.max_turn_rad = max_turn_rad(problem_.rest, shapes_, now_.vertices);
    result.volume_change_ratio = volume_change_ratio(problem_.rest, shapes_, weights_, now_.vertices);
    return result;
  }

  const CageProblem& problem_;
  const DeformOptions& options_;
  const DeformListener& listener_;
  std::vector<TetShape> shapes_;
  std::vector<double> weights_;  // f_T V_T
  CageEnergy energy_;
  CarvedSamples samples_;
  double goal_;
  double penalty_ = 0;
  double promised_ = 0;   // by how much the last step was to change the merit
  bool limited_ = false;  // the last step was as far as most_mean_mm allows
  int iterations_ = 0;
  Iterate now_;
};

std::string range_problem(const char* field, double value, double least, double most) {
  if (value >= least && value <= most) return {};
  return fmt::format("{} is {}; it must lie in [{}, {}]", field, value, least, most);
}

}  // namespace

std::string find_problem(const DeformOptions& o) {
  const std::string problems[] = {
      range_problem("alpha_ratio", o.alpha_ratio, 0.001, 1000),
      range_problem("beta_ratio", o.beta_ratio, 0, 1000),
      range_problem("gamma_ratio", o.gamma_ratio, 0, 1000),
      range_problem("ground_ratio", o.ground_ratio, 0, 1e6),
      o.most_mean_mm > 0 ? "" : fmt::format("most_mean_mm is {}; it must be more than 0", o.most_mean_mm),
      range_problem("most_step_mm", o.most_step_mm, 0.001, 1000),
      range_problem("settled_mm", o.settled_mm, 1e-9, 1),
      range_problem("most_iterations", o.most_iterations, 0, 10000)};
  for (const std::string& problem : problems)
    if (!problem.empty()) return problem;
  return {};
}

Result<CageDeformation> deform_cage(const CageProblem& problem, const DeformOptions& options,
                                    const DeformListener& listener, const Job& job) {
  assert(find_problem(options).empty());
  assert(problem.solid_share.size() == problem.rest.tets.size() &&
         problem.stiffness.size() == problem.rest.tets.size());
  assert(problem.fixed.size() == problem.rest.vertices.size());
  assert(problem.start.empty() || problem.start.size() == problem.rest.vertices.size());
  assert(!problem.balance.rows.empty() && !problem.samples.empty());
  return CageDeformer(problem, options, listener).run(job);
}

}  // namespace aplomb
