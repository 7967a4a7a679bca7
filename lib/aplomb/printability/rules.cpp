#include "aplomb/printability/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace aplomb {
namespace {

using Defaults = std::array<std::optional<Limits>, 4>;

constexpr Limits fails(double at) { return {{}, {}, at}; }
constexpr Limits warns(double at) { return {{}, at, {}}; }
constexpr Limits warns_and_fails(double warn, double fail) { return {{}, warn, fail}; }

constexpr Defaults everywhere(Limits limits) { return {limits, limits, limits, limits}; }

constexpr bool least = true, most = false, a_number = false;

// Walls, holes and bridges: Protolabs' and Formlabs' design rules; span that fails: PrusaSlicer's support generator;
// slopes: Blender's 3D print toolbox, Formlabs; cups: UVtools; angles: IEC 60335-1 20.1; strength: PrusaSlicer and
// Stava et al. 2012. What is our own choice says so in lib/README.md.
constexpr std::array rules{
    CheckRule{"mesh.manifold", "", "edges that are not shared by two triangles in opposite directions", most,
              everywhere(fails(0))},
    CheckRule{"mesh.orientation", "", "shells wound the wrong way for where they lie", most, everywhere(fails(0))},
    CheckRule{"mesh.intersection", "", "pairs of triangles that cross", most, everywhere(fails(0))},
    CheckRule{"mesh.degenerate", "", "triangles without area, or twice there", most, everywhere(fails(0))},
    CheckRule{"mesh.roundtrip", "", "relative difference between what was meant and what the file holds", most,
              everywhere(fails(1e-6))},
    CheckRule{"wall.void_outer",
              "mm",
              "least wall between a void and the outside",
              least,
              {fails(0.8), fails(1.0), fails(0.7), fails(2.0)}},
    CheckRule{"wall.void_void",
              "mm",
              "least wall between two voids",
              least,
              {fails(0.8), fails(1.0), fails(0.7), fails(2.0)}},
    CheckRule{"wall.thin", "mm", "thinnest part of the solid", least, {warns(0.8), warns(0.5), warns(0.7), warns(2.0)}},
    CheckRule{"void.bridge", "mm", "widest unsupported span of a void's ceiling", most, {warns_and_fails(10, 16)}},
    CheckRule{
        "void.slope", "deg", "flattest slope of a void's ceiling that is no bridge", least, {warns(45), warns(19)}},
    CheckRule{"void.island", "mm2", "material that starts in mid-air inside a void", most, {fails(0), fails(0)}},
    CheckRule{"void.closed",
              "",
              "voids with no way out for what is in them",
              most,
              {Limits{0, {}, {}}, fails(0), fails(0), fails(0)}},
    CheckRule{"void.holes", "", "fewest escape holes of a void", least, {std::nullopt, fails(2), fails(2), fails(2)}},
    CheckRule{"void.hole_mm",
              "mm",
              "diameter of an escape hole",
              least,
              {Limits{{}, {}, 1}, fails(3.5), fails(4), fails(5)},
              a_number},
    CheckRule{"void.lone_hole_mm",
              "mm",
              "diameter from which a single escape hole is enough",
              least,
              {std::nullopt, std::nullopt, fails(5)},
              a_number},
    CheckRule{"void.hole_place",
              "mm",
              "how far the lowest hole is above the void's bottom or the vent below its top (sla); what the farthest "
              "holes lack "
              "to half the void's length (powder, binder)",
              most,
              {std::nullopt, warns(2), warns(2), warns(2)}},
    CheckRule{"void.cup", "mm2", "largest suction cup", most, {std::nullopt, fails(1)}},
    CheckRule{"void.cup_mm", "mm", "height from which a cup counts", least, {std::nullopt, fails(0.5)}, a_number},
    CheckRule{"void.base", "mm", "least floor under a void", least, {warns(0.8), fails(0.5)}},
    CheckRule{"stand.nominal", "deg", "tip angle", least, everywhere(fails(10))},
    CheckRule{"stand.robust", "deg", "tip angle at the worst of the tolerances", least,
              everywhere(warns_and_fails(10, 5))},
    CheckRule{"stand.trapped",
              "deg",
              "tip angle with what stays in closed voids",
              least,
              {std::nullopt, fails(10), fails(10), fails(10)}},
    CheckRule{"mass.gained", "%", "mass that the voids add", most, {fails(0)}},
    CheckRule{
        "strength.ankle", "MPa", "stress in the weakest section", most, {fails(16.5), fails(40), fails(45), fails(5)}},
    CheckRule{"strength.fem",
              "MPa",
              "stress that 1 mm3 of the material exceeds",
              most,
              {fails(16.5), fails(40), fails(45), fails(5)}},
    CheckRule{"bed.contact", "mm2", "area of the first layer", least, {warns(25), warns(25)}},
    CheckRule{"print.stands", "", "least share of the support that is left while it is printed", least, {warns(0)}},
};

const CheckRule* find_rule(std::string_view id) {
  const auto* found = std::ranges::find(rules, id, &CheckRule::id);
  return found == rules.end() ? nullptr : found;
}

tl::unexpected<Error> no_such(std::string_view id) {
  std::string ids;
  for (const CheckRule& rule : rules) ids += fmt::format("{}{}", ids.empty() ? "" : ", ", rule.id);
  return fail(ErrorCode::invalid_option, fmt::format("there is no check '{}'; the checks are {}", id, ids));
}

std::optional<double>& severest(Limits& limits) {
  return limits.fail ? limits.fail : limits.warn ? limits.warn : limits.info;
}

}  // namespace

std::optional<Process> process_named(std::string_view name) {
  const auto* found = std::ranges::find(process_names, name);
  if (found == process_names.end()) return std::nullopt;
  return static_cast<Process>(found - process_names.begin());
}

std::span<const CheckRule> check_rules() { return rules; }

std::optional<Limits> Rules::limits(std::string_view id) const {
  if (const auto changed = changed_.find(id); changed != changed_.end()) return changed->second;
  const CheckRule* rule = find_rule(id);
  return rule ? rule->limits[static_cast<std::size_t>(process_)] : std::nullopt;
}

double Rules::number(std::string_view id) const {
  std::optional<Limits> found = limits(id);
  assert(found);
  return *severest(*found);
}

Result<void> Rules::set(std::string_view id, double value) {
  const CheckRule* rule = find_rule(id);
  if (!rule) return no_such(id);
  if (!(std::abs(value) <= 1e9))
    return fail(ErrorCode::invalid_option, fmt::format("the limit of {} is {}; it must lie in [-1e9, 1e9]", id, value));
  Limits limits = rule->limits[static_cast<std::size_t>(process_)].value_or(fails(value));
  std::optional<double>& at = severest(limits);
  at = value;
  for (std::optional<double>* milder : {&limits.warn, &limits.info})
    if (*milder && (rule->is_least ? **milder < value : **milder > value)) *milder = value;
  changed_.insert_or_assign(std::string(id), limits);
  return {};
}

void Rules::adopt(std::string_view id, const Limits& limits) {
  assert(find_rule(id));
  changed_.try_emplace(std::string(id), limits);
}

Result<void> Rules::waive(std::string_view id) {
  if (!find_rule(id)) return no_such(id);
  waived_.emplace(id);
  return {};
}

}  // namespace aplomb
