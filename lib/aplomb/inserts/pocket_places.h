#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/inserts/pocket.h"
#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {

/// A pocket at a place.
struct PocketPlace {
  std::uint32_t pocket = 0;  ///< which of a list
  Vec3 floor_mm;             ///< the lowest point of its axis

  friend bool operator==(const PocketPlace&, const PocketPlace&) = default;
};

/// Where pockets may be looked for: their axes on a square lattice, their floors at some of the boundaries between
/// layers.
struct PlaceOptions {
  double wall_mm = 1.6;         ///< least material between a pocket and anything else, > 0
  double layer_mm = 0.2;        ///< > 0
  double first_layer_mm = 0.2;  ///< > 0
  double least_step_mm =
      0.75;  ///< of the lattice, > 0; more where it would have over 500,000 points in the solid's box
};

/// The places of a lattice where pockets may fit, and whether they do.
class PocketFits {
 public:
  /// Measures the lattice. \pre The mesh of the solid stays; the pockets are sound.
  /// \return cancelled.
  /// \par Cost  a distance (2 us) per point of the lattice, shared by the threads allowed.
  static Result<PocketFits> make(const SolidMesh& solid, std::vector<Pocket> pockets, const PlaceOptions& options,
                                 const Job& job = {});

  /// Every place of the lattice that no distance at a point of the lattice rules out: all that fit, and some that are
  /// short of it by less than a step. In a fixed order.
  std::vector<PocketPlace> candidates() const;

  /// The diameter of the widest upright cylinder of this height that has the wall round it, to about a step; 0 where
  /// there is none.
  double widest_mm(double height_mm) const;

  /// The least distance from the pocket, rounded to float32, to the solid's surface, triangle against triangle, or
  /// `at_most_mm` when that is less; where it does not keep the wall, any number that does not.
  /// \par Cost  1 to 5 ms where it does, less where it does not.
  double wall_mm(const PocketPlace& place, double at_most_mm) const;

  /// Whether the pocket keeps the wall, to 1e-5 mm (float32).
  bool fits(const PocketPlace& place) const;

  /// Whether two pockets at places that fit keep the wall between them; those whose bounding cylinders do not are taken
  /// for too near.
  bool are_apart(const PocketPlace& a, const PocketPlace& b) const;

  const std::vector<Pocket>& pockets() const { return pockets_; }
  const PlaceOptions& options() const { return options_; }
  double step_mm() const;

 private:
  struct Lattice;
  PocketFits(std::vector<Pocket> pockets, const PlaceOptions& options, std::shared_ptr<const Lattice> lattice)
      : pockets_(std::move(pockets)), options_(options), lattice_(std::move(lattice)) {}
  std::vector<Pocket> pockets_;
  PlaceOptions options_;
  std::shared_ptr<const Lattice> lattice_;
};

}  // namespace aplomb
