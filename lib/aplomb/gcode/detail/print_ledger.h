#pragma once

#include <array>
#include <compare>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/gcode/detail/bead_hull.h"
#include "aplomb/gcode/detail/brim_loops.h"
#include "aplomb/gcode/detail/machine.h"
#include "aplomb/gcode/feature.h"
#include "aplomb/gcode/printed_plate.h"

namespace aplomb::detail {

/// How high the bead under the nozzle is, where the slicer does not say: layers are told by the heights at which
/// material is laid down.
class LayerHeights {
 public:
  /// \return the height of the layer whose top is at z_mm.
  double at(double z_mm, std::optional<double> usual_mm);

 private:
  double top_mm_ = 0, height_mm_ = 0;
};

/// Sums up strokes: moments by object and tool, volumes of what is no model's by feature and tool, and what of each
/// object lies on the bed. Memory does not grow with the program, but with its objects: 1,000 have hulls of up to 512
/// corners, those beyond, which are small, of 64: that loses a tenth of a percent.
class PrintLedger {
 public:
  /// \param is_one  whether all objects are parts of the first.
  PrintLedger(const std::vector<Filament>& filaments, bool is_one) : filaments_(filaments), is_one_(is_one) {}

  /// Where the strokes that follow belong; an object without a name: none. \return false beyond 10,000 objects.
  bool turn_to(std::optional<std::string_view> object, Feature feature);
  /// Enters a bead of that height under the stroke. \return false beyond 100,000 pairs of an object and a tool.
  bool enter(const Stroke& stroke, double height_mm);

  /// Whether there are too many objects and loops to tell whose brim is whose: more than a million pairs, as 302
  /// objects with brims of eleven loops have. \pre close()
  bool leaves_brims_out() const { return objects_.size() * brims_.count() > most_brim_pairs; }
  /// What the sums come to: objects, and what is left out. Where the program names features, what comes before the
  /// first is no object's. \return cancelled.
  Result<void> close(bool names_features, PrintedPlate& plate, const Job& job);

 private:
  struct Foot {
    double top_mm = 1e300, height_mm = 0;  // of the lowest layer
    BeadHull hull{512};
    double area_mm2 = 0, length_mm = 0;  // of its beads: width x length
  };
  struct Object {
    std::string name;
    Box3 box_mm{};
    Foot foot{};
  };
  /// Objects that have no label come last: what is named as the model's, and what has no name.
  enum Nameless : std::size_t { nameless_model, nameless_unnamed, nameless_count };
  struct Body {
    std::size_t object;  // nameless ones from `labelled` on
    unsigned tool;
    auto operator<=>(const Body&) const = default;
  };
  static constexpr std::size_t labelled = 10'000, most_bodies = 100'000, large_hulls = 1'000,
                               most_brim_pairs = 1'000'000;

  Object& object_at(std::size_t index) { return index < labelled ? objects_[index] : nameless_[index - labelled]; }
  double volume_of(const Stroke& stroke) const;
  bool enter_moments(const Stroke& stroke, double volume_mm3, double height_mm);
  void enter_model(const Stroke& stroke, double volume_mm3, double height_mm);
  PrintedObject printed(std::size_t index) const;
  void close_left_out(bool names_features, PrintedPlate& plate) const;

  const std::vector<Filament>& filaments_;
  std::vector<Object> objects_;
  std::unordered_map<std::string, std::size_t> index_of_;
  std::array<Object, nameless_count> nameless_;
  std::map<Body, Moments> bodies_;
  std::array<std::array<double, Machine::most_tools>, feature_count> left_out_mm3_{};  // by feature and tool
  BrimLoops brims_;
  bool is_one_;
  Body at_{labelled + nameless_unnamed, 0};
  Feature feature_ = Feature::unnamed;
  Moments* slot_ = nullptr;  // of at_
  double filament_mm_ = 0;
};

}  // namespace aplomb::detail
