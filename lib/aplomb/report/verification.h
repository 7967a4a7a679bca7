#pragma once

#include <string>
#include <string_view>

#include "aplomb/gcode/verify_print.h"

namespace aplomb {

/// What a G-code program prints, for people: the verdict first, then each object's figures, what is left out and what
/// was assumed. Ends with a newline.
std::string to_text(const Verification& verification);

/// The same as JSON: `stands`, `as_told` (with an expected print), `required_tip_deg`, `slicer`, `filament_mm`,
/// `filaments`, `objects`, `left_out`, `notes`; mm, g and degrees, in the bed's coordinates.
std::string to_json(const Verification& verification);

/// What a report that `stand` or `check` wrote promises: `after` where there is one, else `before`, of its first
/// standing pose. \return unusable_input for what is no such report, or has another way up than z.
Result<ExpectedPrint> expected_print(std::string_view report_json);

}  // namespace aplomb
