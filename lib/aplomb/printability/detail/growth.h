#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/mass_properties.h"
#include "aplomb/printability/slices.h"

namespace aplomb::detail {

/// A part of a layer that rests on a part of the layer below.
using Link = std::pair<std::uint32_t, std::uint32_t>;
using Links = std::vector<Link>;

/// Parts overlap when they share more than 1e-6 mm2. \return third_party.
Result<Links> links_between(const Slice& upper, const Slice& lower);

/// Of every layer the links to the layer below; of the first, none. \return cancelled, third_party.
Result<std::vector<Links>> all_links(const Slices& slices, const Job& job);

/// Numbers the parts of all layers one after the other.
class PartNumbers {
 public:
  explicit PartNumbers(const Slices& slices);
  std::uint32_t of(std::size_t layer, std::size_t part) const {
    return firsts_[layer] + static_cast<std::uint32_t>(part);
  }
  std::uint32_t count() const { return firsts_.back(); }

 private:
  std::vector<std::uint32_t> firsts_;  // by layer, and the count
};

/// What a part of a layer is connected to when its layer has just been printed.
struct PrintedSoFar {
  std::uint32_t body = 0;  ///< the same for parts that are connected by then
  Moments moments;         ///< of that body, with all layers up to this one
  /// Where that body stands on the plate, an index into Growth::contacts; nothing where it hangs in mid-air.
  std::optional<std::uint32_t> contact{};
};

struct Growth {
  std::vector<std::vector<PrintedSoFar>> layers;     ///< by layer and part
  std::vector<std::vector<std::uint32_t>> contacts;  ///< sets of parts of the first layer
};

/// Moments of a part with its layer's height.
Moments layer_moments(const SlicePart& part, double z_mm, double layer_mm);

/// Prints the slices layer by layer. \par Cost  O(parts + links), but for sets of contacts that unite.
Growth grow(const Slices& slices, const std::vector<Links>& links);

}  // namespace aplomb::detail
