#include "aplomb/inserts/place_chooser.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>

#include "aplomb/carve/plane_search.h"

namespace aplomb {
namespace {

constexpr double solid_error = 0.02, insert_error = 0.01;  // PRINTABILITY, "Robust"
constexpr double bound_tolerance = 1e-5;
constexpr double never = -std::numeric_limits<double>::infinity();

using Candidates = std::vector<std::uint32_t>;

}  // namespace

double loaded_t(const BalanceProblem& problem, const LoadedBody& body, RowKind kind) {
  if (kind == RowKind::nominal) return largest_t(problem, body.all());
  return std::min(largest_t(problem, (1 + solid_error) * body.solid + (1 - insert_error) * body.inserts),
                  largest_t(problem, (1 - solid_error) * body.solid + (1 + insert_error) * body.inserts));
}

PlaceChooser::PlaceChooser(const PocketFits& fits, std::vector<PocketPlace> candidates, BalanceProblem problem,
                           const Moments& solid, PocketLoads loads)
    : fits_(fits),
      candidates_(std::move(candidates)),
      problem_(std::move(problem)),
      solid_(solid),
      loads_(std::move(loads)),
      known_(candidates_.size(), 0) {
  assert(loads_.stocks.size() == fits.pockets().size() && loads_.density_g_per_cm3 > 0);
  for (const Pocket& pocket : fits.pockets()) {
    const double volume = 1e3 * pocket.mass_g() / loads_.density_g_per_cm3;
    loads_at_origin_.push_back(
        {-loads_.filled_ratio * pocket_moments(pocket, {}), {volume, volume * Vec3{0, 0, pocket.inserts_at_mm}}});
  }
  // Two pockets of a stock in one cell: beside each other they overlap or leave less than 0.7 walls, and one above
  // the other, too; together that is less than a wall.
  std::vector<double> wide(loads_.most.size(), std::numeric_limits<double>::infinity()), high = wide;
  for (std::size_t p = 0; p < fits.pockets().size(); ++p) {
    const std::uint32_t stock = loads_.stocks[p];
    wide[stock] =
        std::min(wide[stock], (2 * fits.pockets()[p].radius_mm + 0.7 * fits.options().wall_mm) / std::sqrt(2.0));
    high[stock] = std::min(high[stock], fits.pockets()[p].height_mm + 0.7 * fits.options().wall_mm);
  }
  std::map<std::tuple<std::uint32_t, int, int, int>, std::size_t> cell_at;
  for (std::uint32_t c = 0; c < candidates_.size(); ++c) {
    const std::uint32_t stock = loads_.stocks[candidates_[c].pocket];
    const Vec3 at = candidates_[c].floor_mm - candidates_.front().floor_mm;
    const auto cell = [](double x, double size) { return static_cast<int>(std::floor(x / size)); };
    const auto [found, is_new] = cell_at.try_emplace(
        {stock, cell(at.x, wide[stock]), cell(at.y, wide[stock]), cell(at.z, high[stock])}, cells_.size());
    if (is_new) cells_.push_back({stock, {}});
    cells_[found->second].members.push_back(c);
  }
}

LoadedBody PlaceChooser::load_of(const PocketPlace& place) const {
  const LoadedBody& load = loads_at_origin_[place.pocket];
  return {{load.solid.volume_mm3, load.solid.first_mm4 + load.solid.volume_mm3 * place.floor_mm},
          {load.inserts.volume_mm3, load.inserts.first_mm4 + load.inserts.volume_mm3 * place.floor_mm}};
}

double PlaceChooser::gain(const AffineForm& form, std::uint32_t candidate) const {
  return form(load_of(candidates_[candidate]).all());
}

/// For each number of inserts of a stock, up to most, those that the form likes best: a knapsack with a choice in each
/// cell.
std::vector<Candidates> PlaceChooser::best_of_stock(const AffineForm& form, std::uint32_t stock, int most) const {
  struct Step {
    std::size_t before;
    std::uint32_t candidate;
  };
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<Step> steps;
  std::vector<double> value(most + 1, never);
  std::vector<std::size_t> last(most + 1, none);
  value[0] = 0;
  for (const Cell& cell : cells_) {
    if (cell.stock != stock) continue;
    std::map<int, std::pair<double, std::uint32_t>> best;  // by the number of inserts
    for (const std::uint32_t c : cell.members) {
      const int stacked = fits_.pockets()[candidates_[c].pocket].stacked;
      if (known_[c] < 0 || stacked > most) continue;
      const double gained = gain(form, c);
      const auto [found, is_new] = best.try_emplace(stacked, gained, c);
      if (!is_new && gained > found->second.first) found->second = {gained, c};
    }
    for (int count = most; count > 0; --count)
      for (const auto& [stacked, choice] : best)
        if (stacked <= count && choice.first > 0 && value[count - stacked] + choice.first > value[count]) {
          value[count] = value[count - stacked] + choice.first;
          steps.push_back({last[count - stacked], choice.second});
          last[count] = steps.size() - 1;
        }
  }
  std::vector<Candidates> chosen(most + 1);
  for (int count = 0; count <= most; ++count)
    for (std::size_t step = last[count]; step != none; step = steps[step].before)
      chosen[count].push_back(steps[step].candidate);
  return chosen;
}

/// The choice that the form likes best, of at most so many inserts of all stocks together.
Candidates PlaceChooser::best_for(const AffineForm& form, int most) const {
  std::vector<double> value(most + 1, 0);
  std::vector<Candidates> best(most + 1);
  for (std::uint32_t stock = 0; stock < loads_.most.size(); ++stock) {
    const auto of_stock = best_of_stock(form, stock, std::min(most, loads_.most[stock]));
    for (int count = most; count > 0; --count)
      for (int added = std::min<int>(count, static_cast<int>(of_stock.size()) - 1); added > 0; --added) {
        double gained = value[count - added];
        for (const std::uint32_t c : of_stock[added]) gained += gain(form, c);
        if (gained <= value[count] || of_stock[added].empty()) continue;
        value[count] = gained;
        best[count] = best[count - added];
        best[count].insert(best[count].end(), of_stock[added].begin(), of_stock[added].end());
      }
  }
  return best[std::max_element(value.begin(), value.end()) - value.begin()];
}

Moments PlaceChooser::relaxed_load(const AffineForm& form, int most) const {
  Moments sum;
  for (const std::uint32_t c : best_for(form, most)) sum += load_of(candidates_[c]).all();
  return sum;
}

Result<PlaceChooser::Plane> PlaceChooser::search(int most, const Job& job) {
  const BestBody best_body = [&](const AffineForm& form) { return solid_ + relaxed_load(form, most); };
  const auto found = PlaneSearch(problem_, best_body, solid_).most_stable(bound_tolerance, job);
  if (!found) return tl::unexpected(found.error());
  return Plane{found->kept, found->bound, best_for(found->kept, most)};
}

Result<double> PlaceChooser::bound(int most, const Job& job) {
  const auto plane = search(most, job);
  return plane ? Result<double>(plane->bound_t) : tl::unexpected(plane.error());
}

}  // namespace aplomb
