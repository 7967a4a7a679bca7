#include "aplomb/printability/escape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aplomb/printability/detail/spots.h"

namespace aplomb {
namespace {

constexpr double apart_ratio = 0.5;  // of a cavity's diagonal, between holes that air is to blow through

std::vector<Opening> holes(const Cavity& cavity, double hole_mm) {
  std::vector<Opening> wide = cavity.openings;
  std::erase_if(wide, [&](const Opening& opening) { return opening.diameter_mm < hole_mm; });
  return wide;
}

/// From an opening's middle to its lower and upper lips.
double lip_mm(const Opening& opening) {
  return 0.5 * opening.diameter_mm * std::sqrt(std::max(0.0, 1 - opening.along.z * opening.along.z));
}

Place drainage(const Cavity& cavity, const std::vector<Opening>& holes) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Opening& hole : holes) {
    lowest = std::min(lowest, hole.at_mm.z - lip_mm(hole));
    highest = std::max(highest, hole.at_mm.z + lip_mm(hole));
  }
  const double left = std::max(0.0, lowest - cavity.lowest_mm.z), air = std::max(0.0, cavity.highest_mm.z - highest);
  return left >= air ? Place{left, cavity.lowest_mm, cavity.box_mm} : Place{air, cavity.highest_mm, cavity.box_mm};
}

Place distance_missing(const Cavity& cavity, const std::vector<Opening>& holes) {
  double apart = 0;
  for (const Opening& one : holes)
    for (const Opening& other : holes) apart = std::max(apart, norm(one.at_mm - other.at_mm));
  return {std::max(0.0, apart_ratio * cavity.box_mm.diagonal() - apart), holes.front().at_mm, cavity.box_mm};
}

/// One hole, so wide that the process asks for no second.
bool are_one_wide(const std::vector<Opening>& holes, const Rules& rules) {
  return holes.size() == 1 && rules.limits("void.lone_hole_mm") &&
         holes.front().diameter_mm >= rules.number("void.lone_hole_mm");
}

/// What is on the wrong side of the limit, or the worst alone; worst first.
std::vector<Place> worst_first(std::vector<Place> places, double limit, bool is_least) {
  const auto is_worse = [&](double a, double b) { return is_least ? a < b : a > b; };
  std::ranges::stable_sort(places, is_worse, &Place::measured);
  const auto passing = std::ranges::find_if(places, [&](const Place& p) { return !is_worse(p.measured, limit); });
  if (!places.empty()) places.erase(std::max(passing, places.begin() + 1), places.end());
  return places;
}

}  // namespace

Result<std::vector<Cavity>> find_cavities(const PrintedSolid& printed, const Rules& rules, const Job& job) {
  const double hole_mm = rules.number("void.hole_mm");
  if (!(hole_mm > 0) || !rules.limits("void.holes")) return closed_shells(printed);
  return find_cavities(printed, hole_mm, job);
}

std::vector<Place> void_closed(std::span<const Cavity> cavities, const Rules& rules) {
  if (!rules.limits("void.closed") || cavities.empty()) return {};
  const double hole_mm = rules.number("void.hole_mm");
  std::vector<Cavity> closed(cavities.begin(), cavities.end());
  std::erase_if(closed, [&](const Cavity& cavity) { return !cavity.is_closed(hole_mm); });
  std::ranges::stable_sort(closed, std::greater<>{}, &Cavity::volume_mm3);
  std::vector<Place> places;
  places.reserve(closed.size());
  for (const Cavity& cavity : closed) places.push_back({1, cavity.deepest_mm, cavity.box_mm});
  if (places.empty()) places.push_back({0, cavities.front().deepest_mm, cavities.front().box_mm});
  return places;
}

std::vector<Place> void_holes(std::span<const Cavity> cavities, const Rules& rules) {
  const auto limit = detail::mildest_limit(rules, "void.holes");
  if (!limit) return {};
  std::vector<Place> places;
  for (const Cavity& cavity : cavities)
    if (const auto wide = holes(cavity, rules.number("void.hole_mm")); !wide.empty())
      places.push_back({are_one_wide(wide, rules) ? *limit : double(wide.size()), wide.front().at_mm, cavity.box_mm});
  return worst_first(std::move(places), *limit, true);
}

std::vector<Place> void_hole_place(std::span<const Cavity> cavities, const Rules& rules) {
  const auto limit = detail::mildest_limit(rules, "void.hole_place");
  if (!limit) return {};
  const bool is_liquid = rules.process() == Process::sla;
  std::vector<Place> places;
  for (const Cavity& cavity : cavities)
    if (const auto wide = holes(cavity, rules.number("void.hole_mm")); !wide.empty() && !are_one_wide(wide, rules))
      places.push_back(is_liquid ? drainage(cavity, wide) : distance_missing(cavity, wide));
  return worst_first(std::move(places), *limit, false);
}

}  // namespace aplomb
