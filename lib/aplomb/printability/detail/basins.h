#pragma once

#include <cstdint>
#include <vector>

#include "aplomb/core/pulse.h"
#include "aplomb/printability/detail/empty_space.h"

namespace aplomb::detail {

/// The empty space parted where it is narrow: a watershed of the clearance. From the widest points down, every lattice
/// point joins the basin of its widest neighbour; where two basins meet, they become one if the place is not much
/// narrower than the smaller one's widest point. Basins that stay apart keep the list of places where they touch.
class Basins {
 public:
  static constexpr std::uint32_t none = ClearanceLattice::none;
  static constexpr std::uint32_t outside = 0;

  /// Two neighbouring points of different basins.
  struct Contact {
    VoxelIndex a, b;
    double clearance_mm = 0;  ///< the lesser of both
    std::uint32_t basin_a = none, basin_b = none;
  };

  /// Points of a clearance of least_mm or more; basins become one where the contact has `merge_ratio` of the smaller
  /// peak. \pre The pulse outlives this; where it stopped, basins are missing.
  /// \par Cost  O(n log n) in the lattice's points.
  Basins(const ClearanceLattice& lattice, double least_mm, double merge_ratio, const Pulse& pulse);

  std::uint32_t count() const { return static_cast<std::uint32_t>(peaks_.size()); }
  /// The basin as it is now; basins that became one have the smallest one's name.
  std::uint32_t find(std::uint32_t basin) const {
    while (parents_[basin] != basin) basin = parents_[basin];
    return basin;
  }
  std::uint32_t of(std::uint32_t element) const { return labels_[element] == none ? none : find(labels_[element]); }
  bool is_root(std::uint32_t basin) const { return find(basin) == basin; }
  double peak_mm(std::uint32_t basin) const { return peaks_[basin].clearance_mm; }
  Vec3 peak_at_mm(std::uint32_t basin) const { return peaks_[basin].at_mm; }
  void set_peak(std::uint32_t basin, Vec3 at_mm, double clearance_mm) { peaks_[basin] = {clearance_mm, at_mm}; }
  void merge(std::uint32_t a, std::uint32_t b);
  /// Contacts of basins that are still apart, under their present names, widest first.
  std::vector<Contact> contacts();

 private:
  struct Peak {
    double clearance_mm = 0;
    Vec3 at_mm;
  };

  std::uint32_t add_basin(std::uint32_t element);
  void spread_wide(std::uint32_t seed);
  void flood(std::uint32_t element, double merge_ratio);

  const ClearanceLattice& lattice_;
  const Pulse& pulse_;
  std::vector<std::uint32_t> labels_;  // per element
  std::vector<Peak> peaks_;
  std::vector<std::uint32_t> parents_;  // per basin: what it became one with, or itself
  std::vector<Contact> contacts_;
};

/// Calls visit(index, element) for the lattice points round an element that are not blocked.
template <class Visit>
void for_neighbours(const ClearanceLattice& lattice, std::uint32_t element, Visit&& visit) {
  const int half = lattice.is_wide_block(element) ? ClearanceLattice::side / 2 : 0;
  const VoxelIndex middle = lattice.index(element);
  const int low = -half - 1, high = half == 0 ? 1 : half;
  for (int i = low; i <= high; ++i)
    for (int j = low; j <= high; ++j)
      for (int k = low; k <= high; ++k) {
        const bool inside = i > low && i < high && j > low && j < high && k > low && k < high;
        if (inside) continue;
        const VoxelIndex index{middle[0] + i, middle[1] + j, middle[2] + k};
        const std::uint32_t other = lattice.element(index);
        if (other != ClearanceLattice::none) visit(index, other);
      }
}

}  // namespace aplomb::detail
