#include "aplomb/printability/detail/basins.h"

#include <algorithm>
#include <limits>

namespace aplomb::detail {

Basins::Basins(const ClearanceLattice& lattice, double least_mm, double merge_ratio, const Pulse& pulse)
    : lattice_(lattice), pulse_(pulse), labels_(lattice.elements(), none) {
  spread_wide(lattice.element({0, 0, 0}));
  peaks_.front().clearance_mm = std::numeric_limits<double>::infinity();
  const auto wide = static_cast<float>(lattice.wide_mm());
  std::vector<std::uint32_t> order;
  for (std::uint32_t element = 0; element < lattice.elements(); ++element) {
    const float clearance = lattice.clearance_mm(element);
    if (clearance >= wide) spread_wide(element);
    else if (clearance >= least_mm) order.push_back(element);
  }
  std::ranges::stable_sort(order, std::greater<>{}, [&](std::uint32_t e) { return lattice.clearance_mm(e); });
  for (const std::uint32_t element : order) {
    if (!pulse_.goes_on(2)) return;
    flood(element, merge_ratio);
  }
}

std::uint32_t Basins::add_basin(std::uint32_t element) {
  peaks_.push_back({lattice_.clearance_mm(element), lattice_.frame().position_mm(lattice_.index(element))});
  parents_.push_back(count() - 1);
  return labels_[element] = parents_.back();
}

void Basins::spread_wide(std::uint32_t seed) {
  if (labels_[seed] != none) return;
  const std::uint32_t basin = add_basin(seed);
  Peak& peak = peaks_[basin];
  const auto wide = static_cast<float>(lattice_.wide_mm());
  for (std::vector<std::uint32_t> stack{seed}; !stack.empty() && pulse_.goes_on(20);) {
    const std::uint32_t element = stack.back();
    stack.pop_back();
    if (const double clearance = lattice_.clearance_mm(element); clearance > peak.clearance_mm)
      peak = {clearance, lattice_.frame().position_mm(lattice_.index(element))};
    for_neighbours(lattice_, element, [&](const VoxelIndex&, std::uint32_t other) {
      if (labels_[other] != none || lattice_.clearance_mm(other) < wide) return;
      labels_[other] = basin;
      stack.push_back(other);
    });
  }
}

void Basins::merge(std::uint32_t a, std::uint32_t b) {
  a = find(a), b = find(b);
  if (a == b) return;
  const std::uint32_t root = std::min(a, b);
  if (peaks_[a + b - root].clearance_mm > peaks_[root].clearance_mm) peaks_[root] = peaks_[a + b - root];
  parents_[std::max(a, b)] = root;
}

void Basins::flood(std::uint32_t element, double merge_ratio) {
  struct Met {
    std::uint32_t basin;
    double clearance_mm;
    VoxelIndex at;
  };
  std::vector<Met> met;  // basins round the point, each by its widest neighbour
  for_neighbours(lattice_, element, [&](const VoxelIndex& index, std::uint32_t other) {
    const std::uint32_t basin = of(other);
    if (basin == none) return;
    const double clearance = lattice_.clearance_mm(other);
    const auto known = std::ranges::find(met, basin, &Met::basin);
    if (known == met.end()) met.push_back({basin, clearance, index});
    else if (clearance > known->clearance_mm) *known = {basin, clearance, index};
  });
  if (met.empty()) {
    add_basin(element);
    return;
  }
  const double here = lattice_.clearance_mm(element);
  std::ranges::stable_sort(met, std::greater<>{}, [&](const Met& m) { return peaks_[m.basin].clearance_mm; });
  for (std::size_t n = 1; n < met.size(); ++n)
    if (here >= merge_ratio * peaks_[met[n].basin].clearance_mm) merge(met[n].basin, met.front().basin);
  const Met& own = *std::ranges::max_element(met, {}, &Met::clearance_mm);
  labels_[element] = find(own.basin);
  for (const Met& other : met)
    if (find(other.basin) != labels_[element])
      contacts_.push_back({lattice_.index(element), other.at, here, labels_[element], find(other.basin)});
}

std::vector<Basins::Contact> Basins::contacts() {
  for (Contact& contact : contacts_) {
    contact.basin_a = find(contact.basin_a);
    contact.basin_b = find(contact.basin_b);
  }
  std::erase_if(contacts_, [](const Contact& contact) { return contact.basin_a == contact.basin_b; });
  std::ranges::stable_sort(contacts_, std::greater<>{}, &Contact::clearance_mm);
  return contacts_;
}

}  // namespace aplomb::detail
