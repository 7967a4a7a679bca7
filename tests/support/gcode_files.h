#pragma once

#include <string>
#include <string_view>

#include "aplomb/gcode/printed_plate.h"

namespace aplomb::test {

/// What the program in `text` prints; by way of a file that is removed again.
Result<PrintedPlate> read_program(std::string_view text, const GcodeOptions& options = {});

/// Absolute coordinates and relative E, at the first layer, 0.2 mm high, with a filament of 1 mm2 and 1 g/cm3: what
/// follows weighs 1e-3 g for each mm of E.
std::string plain_start();
inline const GcodeOptions plain_filament{{1.1283791670955126}, {1.0}};

/// A square loop of beads 0.4 mm wide and 0.2 mm high about a centre, entered at its lower left corner.
std::string square_loop(double x_mm, double y_mm, double side_mm, double z_mm = 0.2);

/// The only object. \pre there is one.
const PrintedObject& only(const Result<PrintedPlate>& plate);
BodyMass mass_of_only(const Result<PrintedPlate>& plate);

}  // namespace aplomb::test
