#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "aplomb/gcode/printed_plate.h"

namespace aplomb {

/// What a report of `stand` or `check` promises of the body, z being up.
struct ExpectedPrint {
  double mass_g = 0;
  double density_g_per_cm3 = 0;
  Vec3 com_mm{};             ///< in the model's coordinates
  double com_height_mm = 0;  ///< above the plate
  double tip_rad = 0;
  std::optional<Box3> box_mm{};  ///< of the model
  Vec2 support_center_mm{};      ///< of the support polygon's box: stands in where there is no box
};

struct VerifyOptions {
  double required_tip_rad = std::numbers::pi / 18;  ///< in [0, pi/2)
  std::string object{};                             ///< by its label, or its number from 1; empty: all of them
  std::optional<ExpectedPrint> expected{};          ///< of each object that is judged
  double most_mass_error_ratio = 0.05;              ///< > 0
  double most_com_error_mm = 0.5;                   ///< > 0
};

/// A sentence that names the field, its value and its range, or nothing.
std::string find_problem(const VerifyOptions& options);

/// The print against what was promised. The print may lie anywhere on the bed: the middles of both boxes, seen from
/// above, are laid over each other, and heights are taken from the plate.
struct PrintError {
  double mass_ratio = 0;         ///< printed / promised - 1; of volumes where the program knows no density
  Vec3 com_mm;                   ///< printed less promised
  bool has_other_size = false;   ///< its box is not the model's: scaled, turned, or another model
  bool is_within_limits = true;  ///< the promise holds
};

struct VerifiedObject {
  PrintedObject printed;
  Stability stability;
  std::optional<Stability> with_brim{};
  std::optional<PrintError> error{};
  bool stands = false;  ///< tip angle as asked, without the brim
};

/// A print as its program has it.
struct Verification {
  PrintedPlate plate;  ///< without the objects
  std::vector<VerifiedObject> objects;
  double required_tip_rad = 0;
  std::optional<double> told_tip_rad{};  ///< of what was expected

  bool all_stand() const;
  bool all_as_told() const;
};

/// Measures how each object stands on its own first layer.
///
/// The layer's hull of beads is the support polygon; a contact of fewer than three corners cannot stand.
/// \pre  find_problem(options) is empty.
/// \return invalid_option when no object has that label or number.
Result<Verification> verify_print(PrintedPlate plate, const VerifyOptions& options);

}  // namespace aplomb
