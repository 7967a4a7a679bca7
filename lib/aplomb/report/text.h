#pragma once

#include <optional>
#include <string>

#include "aplomb/balance/resting.h"
#include "aplomb/report/report.h"

namespace aplomb {

/// The report for people: the verdict first, then the figures, then what was repaired and what would help. Degrees, mm,
/// no more digits than mean something; ends with a newline. The same in every locale. Of several poses, and of one that
/// hangs, each is listed by its name.
std::string to_text(const Report& report);

/// The first line of it: "Falls: tips over to the +x side, -7.9 degrees (10.0 asked)".
std::string verdict(const Report& report);

/// A direction by the axes it follows, to the nearest of 26: "+x", "-y", "+x-y".
std::string direction_word(Vec3 direction);

/// The hint as a sentence that names the flag.
std::string to_text(const RestingHint& hint);

}  // namespace aplomb
