#include "aplomb/drained.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "aplomb/holes/drill.h"
#include "aplomb/holes/hole_places.h"
#include "aplomb/mesh/detail/topology.h"

namespace aplomb {
namespace {

constexpr double aimed_beyond_rad = 0.004 * std::numbers::pi / 180;
constexpr int most_rounds = 16;
constexpr int most_drillings = 4;
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

/// One attempt, drilled and carved again until it stands.
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
      const std::vector<TriangleMesh> voids = void_surfaces(*made_.shell);
      const auto choice = choose_holes(input_.solid.mesh(), voids, demand_, fences_, holes_, part.part(0, 0.2));
      if (!choice) return tl::unexpected(choice.error());
      clock_.lap("holes");
      const bool is_last = round + 1 == most_rounds;
      if (!choice->dead_ends.empty() && !is_last) {
        fill(choice->dead_ends);
        if (const auto carved = carve_again(part.part(0.2, 1)); !carved) return tl::unexpected(carved.error());
        continue;
      }
      if (!choice->dead_ends.empty())
        made_.hints.push_back(
            fmt::format("no escape holes were found for {} part(s) of the voids", choice->dead_ends.size()));
      const auto done = drill_and_weigh(choice->holes, is_last, part.part(0.2, 0.6));
      if (!done) return tl::unexpected(done.error());
      if (*done) break;
      if (const auto carved = carve_again(part.part(0.6, 1)); !carved) return tl::unexpected(carved.error());
    }
    if (made_.shell && made_.shell->voids == 0)
      made_.hints.emplace_back("no void is left that escape holes could be cut to; it is printed solid");
    return std::move(made_);
  }

 private:
  void fill(const std::vector<DeadEnd>& dead_ends) {
    for (const DeadEnd& end : dead_ends)
      made_.volume = without_part(*made_.volume, made_.carving.field, end.seed_mm, end.below_mm);
  }

  Result<void> carve_again(const Job& job) {
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

  /// \return whether it is done: it stands, or there is nothing more to be tried.
  Result<bool> drill_and_weigh(const std::vector<Hole>& holes, bool is_last, const Job& job) {
    if (holes.empty()) return true;
    auto drilled = drill(made_.shell->mesh, made_.shell->outer_triangles, holes, job);
    if (!drilled && drilled.error().code == ErrorCode::third_party) {
      made_.hints.push_back(drilled.error().message);
      return true;
    }
    if (!drilled) return tl::unexpected(drilled.error());
    clock_.lap("drill");
    ++drillings_;
    holes_ = drilled->holes;
    const Moments body = moments(drilled->mesh);
    taken_ = moments(made_.shell->mesh) - body;
    const bool aims = made_.carving.reaches && options_.aim != CarveAim::stable;
    const double short_rad =
        aims ? std::atan(made_.joint.required_t) - std::atan(largest_t(made_.joint.problem, body)) : 0;
    const bool is_enough = aims ? short_rad <= 0 : drillings_ > 1;
    if (!is_enough && !is_last && drillings_ < most_drillings) {
      beyond_rad_ += short_rad > 0 ? short_rad + aimed_beyond_rad : 0;
      return false;
    }
    if (short_rad > 0) made_.carving.reaches = false;
    made_.carving.body = body;
    made_.holes = std::move(drilled->holes);
    made_.shell->mesh = std::move(drilled->mesh);
    made_.shell->outer_triangles = drilled->untouched_outer;
    return true;
  }

  Attempt made_;
  const Input& input_;
  const StandOptions& options_;
  StageClock& clock_;
  const HoleDemand demand_;
  const HoleFences fences_;
  std::vector<Hole> holes_;
  Moments taken_;
  double beyond_rad_ = aimed_beyond_rad;
  int drillings_ = 0;
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
