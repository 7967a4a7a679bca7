#include "aplomb/ceilings.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "aplomb/carve/kept_parts.h"
#include "aplomb/carve/ribs.h"
#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/printability/detail/places.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/slices.h"
#include "aplomb/printability/void_bridge.h"
#include "aplomb/printability/void_island.h"
#include "aplomb/printability/void_slope.h"
#include "aplomb/printability/walls.h"

namespace aplomb {
namespace {

constexpr int most_rounds = 4;
constexpr int most_in_vain = 2;         // rounds that leave as many findings as before
constexpr double rounding = 1e-3;       // of a measure
constexpr double same_place_mm = 2;     // between what is found in the model as it came and in its shell
constexpr double thick_ratio = 1.25;    // of a rib to the least wall: what voxels and simplifying may take
constexpr double slot_ratio = 0.94;     // of a slot to the widest bridge
constexpr double steeper_deg = 2;       // arches than the limit
constexpr double beyond_slope_deg = 1;  // ceilings that nearly are too flat are held, too

struct Wrong {
  std::string_view id;
  Place place;
};

Box3 grown(Box3 box, double by_mm) {
  const Vec3 by{by_mm, by_mm, by_mm};
  return {box.min - by, box.max + by};
}

bool meet(const Box3& a, const Box3& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.min[axis] > b.max[axis] || b.min[axis] > a.max[axis]) return false;
  return true;
}

/// What the judge finds that shaping can help: not what the model brought along.
class CeilingJudge {
 public:
  explicit CeilingJudge(const Rules& rules) : rules_(rules) {}

  /// Looks at the model as it came, whose triangles are the shell's first.
  Result<void> look_at_model(const Shell& shell, const Job& job) {
    inherited_.clear();
    auto found =
        judge(detail::submesh(shell.mesh, [&](std::size_t t) { return t < shell.outer_triangles; }), false, job);
    if (!found) return tl::unexpected(found.error());
    inherited_ = std::move(*found);
    return {};
  }

  /// \param at_once  spans, which cost most, are left out where slopes are wrong already: `all_judged` is false then.
  Result<std::vector<Wrong>> judge(const TriangleMesh& mesh, bool at_once, const Job& job) {
    wrong_.clear();
    all_judged_ = true;
    const auto solid = check_solid(mesh, job.part(0, 0.2));
    if (!solid) return tl::unexpected(solid.error());
    if (!solid->solid) return fail(ErrorCode::internal, "the shell is no solid: " + describe(solid->defects));
    if (solid->solid->voids() == 0) return wrong_;
    const PrintedSolid printed = printed_solid(*solid->solid);
    const auto slices = cut_slices(printed, rules_.layer_mm, job.part(0.2, 0.4));
    if (!slices) return tl::unexpected(slices.error());
    return add("void.slope", [&] { return measure_void_slope(printed, *slices, rules_, job.part(0.4, 0.5)); })
        .and_then([&] {
          return add("void.island", [&] { return measure_void_island(printed, *slices, rules_, job.part(0.5, 0.6)); });
        })
        .and_then([&]() -> Result<void> {
          all_judged_ = !at_once || wrong_.empty();
          if (!all_judged_) return {};
          return add("void.bridge", [&] { return measure_void_bridge(printed, *slices, rules_, job.part(0.6, 0.8)); });
        })
        .and_then(
            [&] { return add("wall.void_void", [&] { return wall_void_void(printed, rules_, job.part(0.8, 1)); }); })
        .map([&] { return std::move(wrong_); });
  }

  bool all_judged() const { return all_judged_; }

 private:
  template <class Measure>
  Result<void> add(std::string_view id, const Measure& measure) {
    const auto limit = detail::mildest_limit(rules_, id);
    if (!limit || rules_.is_waived(id)) return {};
    const auto places = measure();
    if (!places) return tl::unexpected(places.error());
    const bool is_least = std::ranges::find(check_rules(), id, &CheckRule::id)->is_least;
    for (const Place& place : *places)
      if ((is_least ? place.measured < *limit : place.measured > *limit) && !is_inherited(id, place, is_least))
        wrong_.push_back({id, place});
    return {};
  }

  /// Whether the model as it came has as bad a place there.
  bool is_inherited(std::string_view id, const Place& place, bool is_least) const {
    return std::ranges::any_of(inherited_, [&](const Wrong& before) {
      const double worse = is_least ? before.place.measured - place.measured : place.measured - before.place.measured;
      return before.id == id && worse <= rounding * std::abs(place.measured) &&
             meet(grown(before.place.box_mm, same_place_mm), place.box_mm);
    });
  }

  const Rules& rules_;
  std::vector<Wrong> wrong_, inherited_;
  bool all_judged_ = true;
};

/// What is kept, round by round.
class Shaper {
 public:
  Shaper(const SolidVolume& volume, const Rules& rules) : volume_(volume), voxel_mm_(volume.frame().voxel_mm) {
    span_mm_ = detail::mildest_limit(rules, "void.bridge");
    slope_deg_ = detail::mildest_limit(rules, "void.slope").value_or(45);
    const double wall_mm = detail::mildest_limit(rules, "wall.void_void").value_or(0.8);
    thick_mm_ = std::max(thick_ratio * wall_mm, 1.5 * voxel_mm_);
  }

  const std::vector<KeptPart>& kept() const { return kept_; }

  /// Keeps what helps against what was found. \return whether there was anything, if the pulse has not stopped.
  bool answer(const std::vector<Wrong>& wrong, const Attempt& attempt, int round, CeilingFigures& figures,
              const Pulse& pulse) {
    const std::size_t before = kept_.size();
    std::vector<Box3> ceilings;
    for (const auto& [id, place] : wrong) {
      if (id == "void.slope" || id == "void.bridge") ceilings.push_back(grown(place.box_mm, 2 * voxel_mm_));
      if (id == "void.island") add_pillar(place, figures);
      if (id == "wall.void_void") add_fill(place, round, figures);
    }
    if (!ceilings.empty() && span_mm_) add_ribs(ceilings, attempt, round, figures, pulse);
    return kept_.size() > before;
  }

 private:
  void add_pillar(const Place& place, CeilingFigures& figures) {
    Box3 box = grown(place.box_mm, thick_mm_ / 2);
    box.min.z = floor_mm();
    box.max.z = place.box_mm.max.z + thick_mm_;
    kept_.push_back(kept_box(box));
    ++figures.pillars;
  }

  void add_fill(const Place& place, int round, CeilingFigures& figures) {
    kept_.push_back(kept_box(grown(place.box_mm, (1 + 0.5 * round) * thick_mm_)));
    ++figures.fills;
  }

  void add_ribs(const std::vector<Box3>& wrong, const Attempt& attempt, int round, CeilingFigures& figures,
                const Pulse& pulse) {
    const Shell& shell = *attempt.shell;
    const ColumnCosts costs(volume_, attempt.carving.kept, pulse);
    if (pulse.stopped()) return;
    for (const FlatCeiling& ceiling :
         flat_ceilings(shell.mesh, shell.outer_triangles, slope_deg_ + beyond_slope_deg, voxel_mm_)) {
      if (std::ranges::none_of(wrong, [&](const Box3& box) { return meet(box, ceiling.box_mm); })) continue;
      const double held = std::max(0.0, 0.92 - 0.2 * round);
      std::vector<int> cells = wide_cells(ceiling, held * *span_mm_ / 2);
      if (cells.empty()) cells = wide_cells(ceiling, 0);
      const RibOptions options{thick_mm_, slot_ratio * *span_mm_, slope_deg_ + steeper_deg, floor_mm()};
      for (KeptPart& rib : ribs_under(ceiling, cells, costs, options)) {
        kept_.push_back(std::move(rib));
        ++figures.ribs;
      }
    }
  }

  double floor_mm() const { return volume_.frame().origin_mm.z - 10 * voxel_mm_; }

  const SolidVolume& volume_;
  const double voxel_mm_;
  std::optional<double> span_mm_;
  double slope_deg_ = 45, thick_mm_ = 1;
  std::vector<KeptPart> kept_;
};

/// Against what balance alone has.
void compare(CeilingFigures& figures, const Attempt& shaped, const Attempt& as_carved) {
  const JointProblem& joint = as_carved.joint;
  figures.bound_rad = joint.bound_rad(as_carved.carving.bound_t);
  figures.reached_without = as_carved.carving.reaches;
  figures.cost_rad = std::abs(figures.bound_rad - joint.bound_rad(shaped.carving.bound_t));
  figures.material_mm3 = shaped.carving.body.volume_mm3 - as_carved.carving.body.volume_mm3;
}

}  // namespace

Result<Attempt> with_printable_ceilings(const Attempt& as_carved, const Rules& rules, const CarveAgain& carve_again,
                                        const Job& job) {
  assert(as_carved.shell && as_carved.volume);
  CeilingJudge judge(rules);
  Shaper shaper(*as_carved.volume, rules);
  CeilingFigures figures;
  Attempt now = as_carved;
  std::optional<Attempt> best;
  bool best_is_sure = false;
  int in_vain = 0;
  if (const auto looked = judge.look_at_model(*now.shell, job.part(0, 0.1)); !looked)
    return tl::unexpected(looked.error());
  for (int round = 0;; ++round) {
    const Job part =
        job.part(0.1 + 0.9 * round / (most_rounds + 1), std::min(1.0, 0.1 + 0.9 * (round + 1) / (most_rounds + 1)));
    const bool is_last = round == most_rounds || in_vain == most_in_vain;
    const auto wrong = judge.judge(now.shell->mesh, !is_last, part.part(0, 0.4));
    if (!wrong) return tl::unexpected(wrong.error());
    figures.left = wrong->size();
    compare(figures, now, as_carved);
    now.ceiling = figures;
    const bool is_sure = judge.all_judged();
    const bool is_better =
        !best || is_sure > best_is_sure || (is_sure == best_is_sure && figures.left < best->ceiling->left);
    if (is_better) best = now, best_is_sure = is_sure;
    in_vain = is_better ? 0 : in_vain + 1;
    if (wrong->empty() || is_last) break;
    const Pulse pulse(part, 0.4, "carve");
    const bool helps = shaper.answer(*wrong, now, round, figures, pulse);
    if (pulse.stopped()) return cancelled();
    if (!helps) break;
    ++figures.rounds;
    auto again = carve_again(without(*as_carved.volume, shaper.kept()), part.part(0.4, 1));
    if (!again) return tl::unexpected(again.error());
    now = std::move(*again);
  }
  return std::move(*best);
}

}  // namespace aplomb
