#include "aplomb/holes/undrained.h"

#include <algorithm>
#include <span>

#include "aplomb/mesh/solid_mesh.h"
#include "aplomb/printability/escape.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/slices.h"
#include "aplomb/printability/void_cup.h"

namespace aplomb {
namespace {

/// Whether the worst of the places fails.
bool fails(const std::vector<Place>& places, const Rules& rules, std::string_view id) {
  const auto limits = rules.limits(id);
  if (places.empty() || !limits || !limits->fail || rules.is_waived(id)) return false;
  const bool is_least = std::ranges::find(check_rules(), id, &CheckRule::id)->is_least;
  const double measured = places.front().measured;
  return is_least ? measured < *limits->fail : measured > *limits->fail;
}

bool fails(const Cavity& cavity, const Rules& rules) {
  const std::span<const Cavity> one(&cavity, 1);
  return fails(void_closed(one, rules), rules, "void.closed") || fails(void_holes(one, rules), rules, "void.holes") ||
         fails(void_hole_place(one, rules), rules, "void.hole_place");
}

}  // namespace

Result<std::vector<Undrained>> undrained(const TriangleMesh& mesh, const Rules& rules, const Job& job) {
  const auto solid = check_solid(mesh, job.part(0, 0.2));
  if (!solid) return tl::unexpected(solid.error());
  if (!solid->solid) return fail(ErrorCode::internal, "the drilled shell is no solid: " + describe(solid->defects));
  const PrintedSolid printed = printed_solid(*solid->solid);
  const auto cavities = find_cavities(printed, rules, job.part(0.2, 0.7));
  if (!cavities) return tl::unexpected(cavities.error());
  std::vector<Undrained> found;
  for (const Cavity& cavity : *cavities)
    if (fails(cavity, rules)) found.push_back({cavity.deepest_mm, cavity.box_mm, false});
  if (!rules.limits("void.cup")) return found;
  const auto slices = cut_slices(printed, rules.layer_mm, job.part(0.7, 0.9));
  if (!slices) return tl::unexpected(slices.error());
  const auto cups = measure_void_cup(printed, *slices, rules, job.part(0.9, 1));
  if (!cups) return tl::unexpected(cups.error());
  for (const Place& cup : *cups)
    if (fails({cup}, rules, "void.cup")) found.push_back({cup.at_mm, cup.box_mm, true});
  return found;
}

}  // namespace aplomb
