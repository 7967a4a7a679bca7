#pragma once

#include <string>
#include <vector>

#include "aplomb/inserts/insert.h"

namespace aplomb {

/// Where a print is to pause, and what for.
struct Pause {
  double first_print_mm = 0;  ///< above the plate: the top of the first layer after it
  std::string message;        ///< for the printer's display
};

/// The part of a 3MF package in which PrusaSlicer (since 2.2) keeps pauses at heights.
inline constexpr const char* prusaslicer_pauses_path = "Metadata/Prusa_Slicer_custom_gcode_per_print_z.xml";

/// Its text: a pause (type 1, M601) before each of these layers, the lowest first; messages of the same one are joined.
std::string prusaslicer_pauses(std::vector<Pause> pauses);

}  // namespace aplomb
