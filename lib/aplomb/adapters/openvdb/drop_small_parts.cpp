#include <cmath>
#include <cstdint>
#include <numeric>

#include "aplomb/adapters/openvdb/field_operations.h"

namespace aplomb::adapters {
namespace {

using openvdb::Coord;

/// Face-connected negative lattice points, whole tiles taken as one, joined by union-find.
class Parts {
 public:
  Parts(FieldTree& field, const Pulse& pulse) : field_(field), pulse_(pulse) {
    number();
    join_neighbours();
  }

  DroppedParts drop(std::size_t least_points) {
    std::vector<std::size_t> points(places_.size(), 0);
    for (std::uint32_t i = 0; i < places_.size(); ++i) points[root(i)] += places_[i].is_tile ? FieldLeaf::SIZE : 1;
    DroppedParts dropped;
    for (std::uint32_t i = 0; i < places_.size() && pulse_.goes_on(); ++i) {
      const std::size_t size = points[root(i)];
      if (size >= least_points) continue;
      if (root(i) == i) dropped.parts += 1, dropped.points += size;
      if (places_[i].is_tile) field_.addTile(1, places_[i].at, field_.background(), false);
      else field_.setValueOnly(places_[i].at, std::abs(field_.getValue(places_[i].at)));
    }
    return dropped;
  }

 private:
  struct Place {
    Coord at;
    bool is_tile;
  };

  void number() {
    for (auto leaf = field_.cbeginLeaf(); leaf && pulse_.goes_on(20); ++leaf)
      for (openvdb::Index n = 0; n < FieldLeaf::SIZE; ++n)
        if (leaf->getValue(n) < 0) add({leaf->offsetToGlobalCoord(n), false});
    for (const Coord& origin : field_blocks(field_).full) add({origin, true});
    parent_.resize(places_.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  void add(const Place& place) {
    const auto number = static_cast<std::int32_t>(places_.size());
    if (place.is_tile) numbers_.addTile(1, place.at, number, true);
    else numbers_.setValueOnly(place.at, number);
    places_.push_back(place);
  }

  void join_neighbours() {
    openvdb::tree::ValueAccessor<const openvdb::Int32Tree, false> numbers(numbers_);
    const auto join_at = [&](std::uint32_t i, const Coord& neighbour) {
      if (const std::int32_t j = numbers.getValue(neighbour); j >= 0) join(i, static_cast<std::uint32_t>(j));
    };
    for (std::uint32_t i = 0; i < places_.size() && pulse_.goes_on(); ++i) {
      const Coord at = places_[i].at;
      const int side = places_[i].is_tile ? leaf_size : 1;
      for (int u = 0; u < side; ++u)  // every place looks at its least and greatest faces: a point meets a tile too
        for (int v = 0; v < side; ++v)
          for (const int w : {-1, side}) {
            join_at(i, at.offsetBy(w, u, v));
            join_at(i, at.offsetBy(u, w, v));
            join_at(i, at.offsetBy(u, v, w));
          }
    }
  }

  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(std::uint32_t i, std::uint32_t j) {
    i = root(i), j = root(j);
    if (i != j) parent_[std::max(i, j)] = std::min(i, j);
  }

  FieldTree& field_;
  const Pulse& pulse_;
  openvdb::Int32Tree numbers_{-1};
  std::vector<Place> places_;
  std::vector<std::uint32_t> parent_;
};

}  // namespace

DroppedParts drop_small_parts(FieldTree& field, std::size_t least_points, const Pulse& pulse) {
  return least_points > 0 ? Parts(field, pulse).drop(least_points) : DroppedParts{};
}

}  // namespace aplomb::adapters
