#pragma once

#include <string>

#include "aplomb/printability/finding.h"

namespace aplomb {

/// What the judge says, for people: whether it prints, each finding with its place and what helps (of every check the
/// worst few), then what passed and what could not be judged. Ends with a newline.
std::string to_text(const Judgement& judgement);

/// The same as JSON: `process`, `passes`, `new_failures` (ids), `checks` (`id`, `verdict`, `measured`, `threshold`,
/// `unit`, `why`) and `findings` (`id`, `severity`, `measured`, `threshold`, `unit`, `at_mm`, `box_mm`, `in_input`,
/// `text`, `remedy`, `waiver`).
std::string to_json(const Judgement& judgement);

}  // namespace aplomb
