#include "aplomb/drained.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/holes/chambers.h"
#include "aplomb/holes/drill.h"
#include "aplomb/holes/hole_places.h"
#include "aplomb/holes/undrained.h"
#include "aplomb/inserted.h"
#include "aplomb/mesh/detail/topology.h"

namespace aplomb {
namespace {

constexpr double aimed_beyond_rad = 0.004 * std::numbers::pi / 180;
constexpr double bound_tolerance = 1e-6;  // of t
constexpr double everything = std::numeric_limits<double>::infinity();
constexpr int most_rounds = 14;
constexpr int rounds_of_exact_fills = 4;
constexpr int rounds_of_partial_fills = 8;
constexpr int most_drillings = 4;
constexpr int most_mends = 3;
constexpr int most_uncut = 6;
constexpr double least_volume_balls = 4;  // of a void that is worth its holes

/// The surfaces of the carved voids, wound outward from them.
std::vector<TriangleMesh> void_surfaces(const Shell& shell) {
  const TriangleMesh inner =
      reversed(detail::submesh(shell.mesh, [&](std::size_t t) { return t >= shell.outer_triangles; }));
  const detail::Components parts = detail::edge_components(inner, detail::EdgeTable(inner));
  std::vector<TriangleMesh> surfaces;
  for (std::uint32_t part = 0; part < parts.count; ++part)
    surfaces.push_back(detail::submesh(inner, [&](std::size_t t) { return parts.of_triangle[t] == part; }));
  return surfaces;
}

HoleFences fences_of(const StandOptions& options) {
  HoleFences fences{options.poses, options.reshape.regions.kept};
  const auto& locked = options.reshape.regions.locked;
  fences.kept.insert(fences.kept.end(), locked.begin(), locked.end());
  return fences;
}

/// One attempt, drilled and carved again until it stands and the judge has nothing against its holes.
class Drainer {
 public:
  Drainer(Attempt made, const Input& input, const StandOptions& options, StageClock& clock)
      : made_(std::move(made)),
        input_(input),
        options_(options),
        clock_(clock),
        demand_(*hole_demand(options)),
        fences_(fences_of(options)) {}

  Result<Attempt> run(const Job& job) {
    for (int round = 0; made_.shell && made_.shell->voids > 0; ++round) {
      const Job part = job.part(double(round) / most_rounds, double(round + 1) / most_rounds);
      voids_ = void_surfaces(*made_.shell);
      is_last_ = round + 1 >= most_rounds;
      const auto choice = choose_holes(input_.solid.mesh(), voids_, demand_, fences_, holes_, part.part(0, 0.2));
      if (!choice) return tl::unexpected(choice.error());
      clock_.lap("holes");
      auto next = Next::carve;
      if (choice->dead_ends.empty()) {
        const auto done = drill_and_weigh(choice->holes, part.part(0.2, 0.6));
        if (!done) return tl::unexpected(done.error());
        next = *done;
      } else {
        fill(choice->dead_ends, round);
      }
      if (next == Next::nothing) break;
      if (is_last_ && next == Next::carve) next = leave_out_doubtful();
      if (next == Next::choose) continue;
      if (const auto carved = carve_again(part.part(0.6, 1)); !carved) return tl::unexpected(carved.error());
    }
    if (made_.shell && made_.shell->voids == 0)
      if (const auto left = leave_solid(job.part(1, 1)); !left) return tl::unexpected(left.error());
    return std::move(made_);
  }

 private:
  enum class Next { nothing, choose, carve };

  /// More of it with every round: what is left of a void that was filled in part may have dead ends again.
  void fill(const std::vector<DeadEnd>& dead_ends, int round) {
    for (const DeadEnd& end : dead_ends) {
      const double more = std::max(0, round - rounds_of_exact_fills) * demand_.bore_mm();
      const double below = round < rounds_of_partial_fills ? end.below_mm + more : everything;
      fill(end.seed_mm, below);
    }
  }

  void fill(Vec3 seed_mm, double below_mm) {
    made_.volume = without_part(*made_.volume, made_.carving.field, seed_mm, below_mm);
    doubtful_mm_.push_back(seed_mm);
  }

  /// Instead of carving once more: the voids that would be filled in part stay solid altogether.
  Next leave_out_doubtful() {
    std::size_t left_out = 0;
    TriangleMesh inner;
    for (const TriangleMesh& surface : voids_) {
      const adapters::SurfaceDistance distance(surface);
      const bool is_doubtful = std::ranges::any_of(doubtful_mm_, [&](Vec3 at) {
        const auto nearest = distance.closest(at);
        return nearest.distance_mm < 1e-6 || distance.inside(at, nearest);
      });
      if (is_doubtful) ++left_out;
      else inner = joined(std::move(inner), surface);
    }
    Shell& shell = *made_.shell;
    const TriangleMesh outer = detail::submesh(shell.mesh, [&](std::size_t t) { return t < shell.outer_triangles; });
    shell.mesh = joined(outer, reversed(inner));
    doubtful_mm_.clear();
    shell.voids -= std::min(left_out, shell.voids);
    made_.carving.body = moments(shell.mesh);
    made_.carving.reaches = is_reached(made_.carving.body);
    return left_out > 0 ? Next::choose : Next::nothing;
  }

  /// No void is left, so that nothing is taken by the holes of those that were.
  Result<void> leave_solid(const Job& job) {
    taken_ = {};
    made_.carving.body = moments(made_.shell->mesh);
    made_.carving.reaches = is_reached(made_.carving.body);
    made_.hints.emplace_back("no void is left that escape holes could be cut to; it is printed solid");
    return certify(made_.carving.body, job);
  }

  bool aims() const { return options_.aim != CarveAim::stable; }
  double short_rad(const Moments& body) const {
    return std::atan(made_.joint.required_t) - std::atan(largest_t(made_.joint.problem, body));
  }
  bool is_reached(const Moments& body) const { return made_.carving.reaches && (!aims() || short_rad(body) <= 0); }

  Result<void> carve_again(const Job& job) {
    doubtful_mm_.clear();
    auto carved = carve_shell(*made_.volume, input_, made_.joint, options_, {taken_, beyond_rad_}, clock_, job);
    if (!carved) return tl::unexpected(carved.error());
    carved->hints = std::move(made_.hints);
    carved->ceiling = made_.ceiling;
    made_ = std::move(*carved);
    if (made_.shell || !options_.best_effort) return {};
    auto shell = build_shell(input_.solid, made_.carving.field, {.wall_mm = options_.wall_mm}, job);
    if (!shell) return tl::unexpected(shell.error());
    made_.shell = std::move(*shell);
    return {};
  }

  /// All holes at once, or one by one; nothing where some cannot be cut: no hole will be there again.
  Result<std::optional<Drilled>> cut(const std::vector<Hole>& holes, const Job& job) {
    auto all = drill(made_.shell->mesh, made_.shell->outer_triangles, holes, job.part(0, 0.5));
    if (all) return std::optional(std::move(*all));
    if (all.error().code != ErrorCode::third_party) return tl::unexpected(all.error());
    Drilled drilled{made_.shell->mesh, 0, made_.shell->outer_triangles, {}};
    bool is_whole = true;
    for (const Hole& hole : holes) {
      auto one = drill(drilled.mesh, drilled.untouched_outer, {&hole, 1}, job.part(0.5, 1));
      if (!one && one.error().code != ErrorCode::third_party) return tl::unexpected(one.error());
      if (!one) {
        is_whole = false;
        fences_.kept.push_back({hole.at(hole.mouth_mm), 0.5 * hole.bore_mm});
        if (++uncut_ > most_uncut || is_last_) fill(hole.inside_mm, everything);
        continue;
      }
      one->holes.insert(one->holes.begin(), drilled.holes.begin(), drilled.holes.end());
      drilled = std::move(*one);
    }
    if (!is_whole) return std::optional<Drilled>();
    return std::optional(std::move(drilled));
  }

  Result<Next> drill_and_weigh(const std::vector<Hole>& holes, const Job& job) {
    if (holes.empty()) return Next::nothing;
    auto cut_holes = cut(holes, job.part(0, 0.7));
    if (!cut_holes) return tl::unexpected(cut_holes.error());
    clock_.lap("drill");
    if (!*cut_holes) return doubtful_mm_.empty() ? Next::choose : Next::carve;
    Drilled& drilled = **cut_holes;
    ++drillings_;
    holes_ = drilled.holes;
    const Moments body = moments(drilled.mesh);
    taken_ = moments(made_.shell->mesh) - body;
    const bool weighs = made_.carving.reaches && aims();
    const bool is_enough = weighs ? short_rad(body) <= 0 : drillings_ > 1;
    if (!is_enough && !is_last_ && drillings_ < most_drillings) {
      beyond_rad_ += weighs ? short_rad(body) + aimed_beyond_rad : 0;
      return Next::carve;
    }
    const auto mended = mend(drilled.mesh, job.part(0.7, 1));
    if (!mended) return tl::unexpected(mended.error());
    clock_.lap("judge holes");
    if (*mended) return Next::carve;
    if (const auto bounded = certify(body, job.part(1, 1)); !bounded) return tl::unexpected(bounded.error());
    made_.carving.reaches = is_reached(body);
    made_.carving.body = body;
    made_.holes = std::move(drilled.holes);
    made_.shell->mesh = std::move(drilled.mesh);
    made_.shell->outer_triangles = drilled.untouched_outer;
    return Next::nothing;
  }

  /// These holes may take other material than those that the void was carved with: the bound is to be of these.
  Result<void> certify(const Moments& drilled, const Job& job) {
    const Moments inserts = inserts_as_solid(input_.inserts, options_), solid = input_.moments - taken_ + inserts;
    const auto bound = carving_bound(*made_.volume, solid, made_.joint.problem, bound_tolerance, job);
    if (!bound) return tl::unexpected(bound.error());
    made_.carving.bound_t = *bound;
    made_.carving.t = largest_t(made_.joint.problem, drilled + inserts);
    return {};
  }

  /// Keeps from being carved what helps against what the judge finds in the carved voids. \return whether anything was.
  Result<bool> mend(const TriangleMesh& drilled, const Job& job) {
    const auto found = undrained(drilled, options_.judge.rules, job);
    if (!found) return tl::unexpected(found.error());
    bool is_any = false;
    for (const TriangleMesh& surface : voids_) {
      const adapters::SurfaceDistance distance(surface);
      for (const Undrained& wrong : *found) {
        const auto nearest = distance.closest(wrong.at_mm);
        if (nearest.distance_mm > demand_.bore_mm() && !distance.inside(wrong.at_mm, nearest)) continue;
        mend(surface, wrong);
        is_any = true;
      }
    }
    if (is_any) {
      ++mends_;
      drillings_ = std::min(drillings_, most_drillings - 2);
    }
    return is_any;
  }

  /// A wall in the neck that makes two cavities of one void, each of which then gets its holes; under a cup, a floor.
  void mend(const TriangleMesh& surface, const Undrained& wrong) {
    const double thick = std::max(demand_.wall_mm, 2 * made_.volume->frame().voxel_mm);
    if (!wrong.is_cup && mends_ < most_mends)
      if (const auto wall = wall_round_chamber(surface, wrong.at_mm, demand_.ball_mm, thick)) {
        made_.volume = without(*made_.volume, {*wall});
        doubtful_mm_.push_back(lowest_in(surface, wrong));
        return;
      }
    const double below = wrong.box_mm.max.z + 0.5 * demand_.cup_mm;
    fill(lowest_in(surface, wrong), wrong.is_cup && mends_ < most_mends ? below : everything);
  }

  /// A point of the void in that place.
  static Vec3 lowest_in(const TriangleMesh& surface, const Undrained& wrong) {
    constexpr double beside_mm = 0.5;
    const Vec3* lowest = nullptr;
    for (const Vec3& v : surface.vertices) {
      bool is_in = true;
      for (int axis = 0; axis < 3; ++axis)
        is_in &= v[axis] > wrong.box_mm.min[axis] - beside_mm && v[axis] < wrong.box_mm.max[axis] + beside_mm;
      if (is_in && (!lowest || v.z < lowest->z)) lowest = &v;
    }
    return lowest ? *lowest : wrong.at_mm;
  }

  Attempt made_;
  const Input& input_;
  const StandOptions& options_;
  StageClock& clock_;
  const HoleDemand demand_;
  HoleFences fences_;
  std::vector<TriangleMesh> voids_;
  std::vector<Vec3> doubtful_mm_;  // in the voids that are to be filled, in part at least
  std::vector<Hole> holes_;
  Moments taken_;
  double beyond_rad_ = aimed_beyond_rad;
  int drillings_ = 0;
  int mends_ = 0;
  int uncut_ = 0;
  bool is_last_ = false;
};

}  // namespace

std::optional<HoleDemand> hole_demand(const StandOptions& options) {
  return options.holes == Holes::automatic ? hole_demand(options.judge.rules) : std::nullopt;
}

StandOptions with_voids_for_holes(StandOptions options) {
  const auto demand = hole_demand(options);
  if (!demand) return options;
  const double radius = 0.5 * demand->bore_mm();
  options.least_void_mm = std::max(options.least_void_mm, 2 * radius);
  options.least_volume_mm3 =
      std::max(options.least_volume_mm3, least_volume_balls * 4 / 3 * std::numbers::pi * radius * radius * radius);
  return options;
}

Result<Attempt> drained(Attempt made, const Input& input, const StandOptions& options, StageClock& clock,
                        const Job& job) {
  assert(made.shell && made.volume);
  return Drainer(std::move(made), input, options, clock).run(job);
}

}  // namespace aplomb
