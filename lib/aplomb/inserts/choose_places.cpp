#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "aplomb/inserts/place_chooser.h"

// How a choice is found; what bounds it is in place_chooser.cpp.

namespace aplomb {
namespace {

constexpr double worth = 1e-7;  // of t: less is no gain
constexpr std::size_t most_listed = 20'000;
constexpr std::size_t beam_weighings = 1'000'000;
constexpr std::size_t most_for_pairs = 8;
constexpr int most_sweeps = 6;

using Candidates = std::vector<std::uint32_t>;

Candidates without(const Candidates& chosen, std::size_t i, std::size_t j) {
  Candidates rest;
  for (std::size_t k = 0; k < chosen.size(); ++k)
    if (k != i && k != j) rest.push_back(chosen[k]);
  return rest;
}

}  // namespace

/// Of each cell and pocket those that the form likes best, the best first.
Candidates PlaceChooser::shortlist(const AffineForm& form) const {
  const std::size_t kinds = std::max<std::size_t>(1, cells_.size() * fits_.pockets().size());
  const std::size_t most_each = std::clamp<std::size_t>(most_listed / kinds, 4, 400);
  std::vector<std::pair<double, std::uint32_t>> listed;
  for (const Cell& cell : cells_) {
    std::map<std::uint32_t, std::vector<std::pair<double, std::uint32_t>>> by_pocket;
    for (const std::uint32_t c : cell.members)
      if (known_[c] >= 0) by_pocket[candidates_[c].pocket].emplace_back(-gain(form, c), c);
    for (auto& [pocket, members] : by_pocket) {
      std::ranges::sort(members);
      members.resize(std::min(members.size(), most_each));
      for (const auto& [loss, c] : members) listed.emplace_back(loss / fits_.pockets()[pocket].stacked, c);
    }
  }
  std::ranges::sort(listed);
  Candidates list;
  for (const auto& [loss, c] : listed) list.push_back(c);
  return list;
}

int PlaceChooser::inserts_of(const Candidates& chosen) const {
  int sum = 0;
  for (const std::uint32_t c : chosen) sum += fits_.pockets()[candidates_[c].pocket].stacked;
  return sum;
}

LoadedBody PlaceChooser::body_of(const Candidates& chosen) const {
  LoadedBody body{solid_, {}};
  for (const std::uint32_t c : chosen) {
    const LoadedBody load = load_of(candidates_[c]);
    body.solid += load.solid;
    body.inserts += load.inserts;
  }
  return body;
}

double PlaceChooser::worth_of(const LoadedBody& body) const {
  return liked_ ? (*liked_)(body.all()) : loaded_t(problem_, body, loads_.kind);
}

double PlaceChooser::worth_of(const Candidates& chosen) const { return worth_of(body_of(chosen)); }

/// Not told, so no, where the pulse stopped.
bool PlaceChooser::asked_fits(std::uint32_t candidate, const Pulse& pulse) {
  if (known_[candidate] == 0 && pulse.goes_on(1000)) known_[candidate] = fits_.fits(candidates_[candidate]) ? 1 : -1;
  return known_[candidate] > 0;
}

Result<bool> PlaceChooser::any_fits(const Job& job) {
  const Pulse pulse(job, 1, "place inserts");
  for (std::uint32_t c = 0; c < candidates_.size() && !pulse.stopped(); ++c)
    if (asked_fits(c, pulse)) return true;
  if (pulse.stopped()) return cancelled();
  return false;
}

/// Whether there are enough inserts, and it is apart from the others and fits.
bool PlaceChooser::may_join(const Candidates& chosen, std::uint32_t candidate, int most, const Pulse& pulse) {
  const std::uint32_t pocket = candidates_[candidate].pocket, stock = loads_.stocks[pocket];
  int all = fits_.pockets()[pocket].stacked, of_stock = all;
  for (const std::uint32_t c : chosen) {
    const int stacked = fits_.pockets()[candidates_[c].pocket].stacked;
    all += stacked;
    if (loads_.stocks[candidates_[c].pocket] == stock) of_stock += stacked;
  }
  if (known_[candidate] < 0 || all > most || of_stock > loads_.most[stock]) return false;
  for (const std::uint32_t c : chosen)
    if (!fits_.are_apart(candidates_[c], candidates_[candidate])) return false;
  return asked_fits(candidate, pulse);
}

void PlaceChooser::fill_by_plane(Candidates& chosen, const Candidates& by_gain, int most, const Pulse& pulse) {
  for (const std::uint32_t c : by_gain) {
    if (inserts_of(chosen) >= most) return;
    if (may_join(chosen, c, most, pulse)) chosen.push_back(c);
  }
}

/// Those that would make most of a choice, and with what worth, the best first; none that would make less of it.
std::vector<std::pair<double, std::uint32_t>> PlaceChooser::best_to_join(const Candidates& chosen,
                                                                         const Candidates& among, int most,
                                                                         std::size_t count, const Pulse& pulse) {
  const LoadedBody body = body_of(chosen);
  const double now = worth_of(body);
  std::vector<std::pair<double, std::uint32_t>> better;  // the worth with its sign changed: sorts the best first
  for (const std::uint32_t c : among) {
    if (known_[c] < 0) continue;
    if (!pulse.goes_on()) break;
    const LoadedBody load = load_of(candidates_[c]);
    const double then = worth_of({body.solid + load.solid, body.inserts + load.inserts});
    if (then > now + worth) better.emplace_back(-then, c);
  }
  std::ranges::make_heap(better, std::greater{});
  std::vector<std::pair<double, std::uint32_t>> best;
  while (!better.empty() && best.size() < count && !pulse.stopped()) {
    if (may_join(chosen, better.front().second, most, pulse))
      best.emplace_back(-better.front().first, better.front().second);
    std::ranges::pop_heap(better, std::greater{});
    better.pop_back();
  }
  return best;
}

void PlaceChooser::fill_by_worth(Candidates& chosen, const Candidates& among, int most, const Pulse& pulse) {
  while (inserts_of(chosen) < most) {
    const auto best = best_to_join(chosen, among, most, 1, pulse);
    if (best.empty()) return;
    chosen.push_back(best.front().second);
  }
}

/// Keeps the best choices of one pocket, of two, and so on.
Result<Candidates> PlaceChooser::best_of_beam(const Candidates& among, int most, const Job& job) {
  const std::size_t scans = beam_weighings / std::max<std::size_t>(1, among.size());
  const std::size_t width = std::clamp<std::size_t>(scans / static_cast<std::size_t>(most), 2, 200);
  std::vector<Candidates> beam{{}};
  Candidates best;
  for (int step = 0; step < most; ++step) {
    std::map<Candidates, double> next;
    const Pulse pulse(job, double(step) / most, "place inserts");
    for (const Candidates& chosen : beam) {
      if (inserts_of(chosen) >= most) continue;
      for (const auto& [then, c] : best_to_join(chosen, among, most, width, pulse)) {
        Candidates longer = chosen;
        longer.insert(std::ranges::lower_bound(longer, c), c);
        next.emplace(std::move(longer), then);
      }
    }
    if (pulse.stopped()) return cancelled();
    if (next.empty()) break;
    std::vector<std::pair<double, Candidates>> ranked;
    ranked.reserve(next.size());
    for (auto& [chosen, value] : next) ranked.emplace_back(-value, chosen);
    std::ranges::sort(ranked);
    ranked.resize(std::min(ranked.size(), width));
    beam.clear();
    for (auto& [value, chosen] : ranked) beam.push_back(std::move(chosen));
    if (worth_of(beam.front()) > worth_of(best)) best = beam.front();
  }
  return best;
}

Result<void> PlaceChooser::exchange(Candidates& chosen, const Candidates& among, int most, const Job& job) {
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const double before = worth_of(chosen);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      for (std::size_t j = i; j < (chosen.size() <= most_for_pairs ? chosen.size() : i + 1); ++j) {
        const Pulse pulse(job, (sweep + double(i) / double(chosen.size())) / most_sweeps, "place inserts");
        Candidates other = without(chosen, i, j);
        fill_by_worth(other, among, most, pulse);
        if (pulse.stopped()) return cancelled();
        if (worth_of(other) > worth_of(chosen) + worth) chosen = std::move(other);
        if (i >= chosen.size()) break;
      }
    if (worth_of(chosen) <= before + worth) break;
  }
  return {};
}

Result<PocketChoice> PlaceChooser::improved(const Plane& plane, int most, const Job& job) {
  const Candidates among = shortlist(plane.form);
  auto from_beam = best_of_beam(among, most, job.part(0, 0.4));
  if (!from_beam) return tl::unexpected(from_beam.error());
  Candidates from_plane;
  const Pulse at_first(job, 0.4, "place inserts");
  fill_by_plane(from_plane, plane.relaxed, most, at_first);
  if (at_first.stopped()) return cancelled();
  Candidates best;
  double from = 0.4;
  for (Candidates chosen : {std::move(*from_beam), std::move(from_plane)}) {
    const Pulse pulse(job, from, "place inserts");
    fill_by_worth(chosen, among, most, pulse);
    if (!liked_) fill_by_plane(chosen, among, most, pulse);
    if (pulse.stopped()) return cancelled();
    if (const auto done = exchange(chosen, among, most, job.part(from, from + 0.3)); !done)
      return tl::unexpected(done.error());
    from += 0.3;
    if (worth_of(chosen) > worth_of(best) + worth) best = std::move(chosen);
  }
  PocketChoice choice{{}, body_of(best), inserts_of(best), 0, plane.bound_t};
  choice.t = loaded_t(problem_, choice.body, loads_.kind);
  for (const std::uint32_t c : best) choice.places.push_back(candidates_[c]);
  return choice;
}

Result<PocketChoice> PlaceChooser::choose(int most, const Job& job) {
  liked_.reset();
  auto plane = search(most, job.part(0, 0.3));
  if (!plane) return tl::unexpected(plane.error());
  plane->bound_t = std::max(plane->bound_t, loaded_t(problem_, {solid_, {}}, loads_.kind));
  return improved(*plane, most, job.part(0.3, 1));
}

Result<PocketChoice> PlaceChooser::choose_for(const AffineForm& form, int most, const Job& job) {
  const double scale = form(relaxed_load(form, most));  // the most that any choice adds
  liked_ = scale > 0 ? (1 / scale) * form : form;
  return improved({form, std::numeric_limits<double>::infinity(), best_for(form, most)}, most, job);
}

}  // namespace aplomb
