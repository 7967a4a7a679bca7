#pragma once

#include <optional>
#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/core/polygon.h"
#include "aplomb/fdm/predict_print.h"
#include "aplomb/fdm/print_profile.h"

namespace aplomb {

/// Infill of another density on one side of a plane: what a slicer makes of a modifier volume.
struct DenseInfill {
  AffineForm dense;         ///< where this is positive at the middle of a layer
  double infill_ratio = 1;  ///< in [0, 1]; 1 is solid infill, wherever there was sparse
};

/// A print, layer by layer, whose sparse core may be filled in more than one way.
///
/// Walls and skins are as predict_print() has them, and do not depend on the filling: modifier volumes that change
/// nothing but the infill leave them alone, in PrusaSlicer as in Cura.
class LayeredPrint {
 public:
  /// \pre  find_problem(profile) is empty; the solid stands on the plate, up is +z.
  /// \return as cut_slices(), third_party.
  /// \par Cost  O(layers n) set operations on polygons, n being the number of layers in a skin.
  static Result<LayeredPrint> make(const PrintedSolid& printed, const PrintProfile& profile, const Job& job = {});

  /// The same with another density of infill throughout; nothing where its walls and skins would be others, too.
  /// \pre  infill_ratio in [0, 1].
  std::optional<LayeredPrint> with_infill(double infill_ratio) const;

  /// What is laid down. \par Cost  a few set operations a layer.
  Result<PredictedPrint> fill(const std::optional<DenseInfill>& denser = {}, const Job& job = {}) const;

  /// What the denser infill adds to fill(), to first order: cores that the plane makes too small to stay sparse, and
  /// bridges over what is sparse, are as without it. \par Cost  linear in the corners of the layers.
  Moments added_by(const DenseInfill& denser) const;

  const PrintProfile& profile() const { return profile_; }

 private:
  struct Layer {
    Polygons outline, core;
    Moments walls;    ///< laid at a flow ratio of 1
    Polygons open;    ///< of the core: without its skins, which are filled whatever the infill
    Polygons sparse;  ///< what of that stays sparse where nothing else is asked for
    double height_mm = 0, middle_mm = 0;

    HalfPlane half(const AffineForm& form) const {
      return {form.constant + form.gradient.z * middle_mm, {form.gradient.x, form.gradient.y}};
    }
  };
  struct Filling;
  class Skins;

  explicit LayeredPrint(const PrintProfile& profile) : profile_(profile) {}
  double share(double infill_ratio, const Polygons& region) const;

  PrintProfile profile_;
  std::vector<Layer> layers_;
};

}  // namespace aplomb
