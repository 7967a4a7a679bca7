#include "aplomb/carve/carve.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "aplomb/carve/moment_tree.h"
#include "aplomb/carve/plane_search.h"
#include "aplomb/core/pulse.h"

namespace aplomb {
namespace {

constexpr double search_tolerance = 1e-7;  // of t
constexpr double t_tolerance = 1e-5;       // by which the void as cut may miss required_t: 0.0006 degree
constexpr int most_rounds = 6;

BestBody best_body(const Moments& solid, const MomentTree& tree) {
  return [&solid, &tree](const AffineForm& kept) { return solid - tree.not_positive_part(kept); };
}

/// One carving of one volume; another round follows when parts were dropped.
class Carver {
 public:
  /// Where the pulse stopped, of no use.
  Carver(const SolidVolume& volume, const Moments& solid, const BalanceProblem& problem, const CarveOptions& options,
         const Pulse& pulse)
      : volume_(volume),
        solid_(solid),
        problem_(problem),
        options_(options),
        tree_(carvable_blocks(volume, pulse), volume.frame()),
        search_(problem, best_body(solid, tree_), solid) {}

  Result<VoidCut> choose(Carving& carving, const Job& job) {
    const auto stable = search_.most_stable(search_tolerance, job.part(0, 0.3));
    if (!stable) return tl::unexpected(stable.error());
    carving.bound_t = stable->bound;
    carving.planes += search_.planes();
    if (options_.aim == CarveAim::stable || stable->bound < options_.required_t)
      return cut(*stable, carving, job.part(0, 0.3));
    return meet_requirement(*stable, carving, job.part(0.3, 1));
  }

 private:
  Result<VoidCut> cut(const PlaneChoice& plane, Carving& carving, const Job& job) const {
    auto cut = cut_void(volume_, plane.kept, options_.least_volume_mm3, job);
    if (!cut) return cut;
    carving.kept = plane.kept;
    carving.body = solid_ - cut->field.moments();
    carving.t = largest_t(problem_, carving.body);
    return cut;
  }

  /// The void as cut differs from the planned one by the cells that the plane cuts and by what its opening took: what
  /// comes out short (or over) is asked for in addition.
  Result<VoidCut> meet_requirement(const PlaneChoice& stable, Carving& carving, const Job& job) {
    const VolumeAim aim = options_.aim == CarveAim::least ? VolumeAim::most : VolumeAim::least;
    double asked = options_.required_t;
    Result<VoidCut> result;
    for (int round = 0; round < most_rounds; ++round) {
      const int planes_before = search_.planes();
      const Job part = job.part(double(round) / most_rounds, (round + 1.0) / most_rounds);
      const auto plane = search_.extreme_volume(aim, std::min(asked, stable.t), stable, part);
      if (!plane) return tl::unexpected(plane.error());
      carving.planes += search_.planes() - planes_before;
      if (round == 0) carving.volume_bound_mm3 = solid_.volume_mm3 - plane->bound;
      result = cut(*plane, carving, part);
      if (!result) return result;
      const double missing = options_.required_t - carving.t;
      if (std::abs(missing) <= t_tolerance || (missing > 0 && asked >= stable.t)) break;
      if (missing < 0 && plane->t > asked + t_tolerance) break;  // the angle is no limit
      asked += missing;
    }
    if (carving.t < options_.required_t - t_tolerance) result = cut(stable, carving, job);
    return result;
  }

  const SolidVolume& volume_;
  const Moments& solid_;
  const BalanceProblem& problem_;
  const CarveOptions& options_;
  MomentTree tree_;
  PlaneSearch search_;
};

}  // namespace

std::string find_problem(const CarveOptions& o) {
  if (!std::isfinite(o.required_t)) return fmt::format("required_t is {}; it must be finite", o.required_t);
  if (!(o.least_volume_mm3 >= 0 && o.least_volume_mm3 <= 1e9))
    return fmt::format("least_volume_mm3 is {}; it must lie in [0, 1e9]", o.least_volume_mm3);
  return {};
}

Result<Carving> carve(const SolidVolume& volume, const Moments& solid, const BalanceProblem& problem,
                      const CarveOptions& options, const Job& job) {
  assert(find_problem(options).empty());
  Carving carving;
  carving.body = solid;
  SolidVolume allowed = volume;
  for (int round = 0; round < most_rounds; ++round) {
    const Job part = job.part(double(round) / most_rounds, (round + 1.0) / most_rounds);
    const Pulse pulse(part, 0, "carve");
    Carver carver(allowed, solid, problem, options, pulse);
    if (pulse.stopped()) return cancelled();
    auto cut = carver.choose(carving, part);
    if (!cut) return tl::unexpected(cut.error());
    carving.field = cut->field;
    carving.dropped_parts += cut->dropped_parts;
    carving.dropped_mm3 += cut->dropped_mm3;
    if (!cut->without_dropped) break;
    allowed = *cut->without_dropped;
  }
  carving.reaches = options.aim == CarveAim::stable || carving.t >= options.required_t - t_tolerance;
  if (!job.report(1, "carve")) return cancelled();
  return carving;
}

Result<double> carving_bound(const SolidVolume& volume, const Moments& solid, const BalanceProblem& problem,
                             double tolerance, const Job& job) {
  const Pulse pulse(job, 0, "carve");
  const MomentTree tree(carvable_blocks(volume, pulse), volume.frame());
  if (pulse.stopped()) return cancelled();
  PlaneSearch search(problem, best_body(solid, tree), solid);
  const auto stable = search.most_stable(tolerance, job);
  if (!stable) return tl::unexpected(stable.error());
  return stable->bound;
}

}  // namespace aplomb
