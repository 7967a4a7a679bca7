#pragma once

#include <string>

#include "aplomb/report/report.h"

namespace aplomb {

/// The report as JSON, indented, its keys in a fixed order and stable between versions; mm and degrees. Points are
/// [x, y, z] in the model's own coordinates. What the report lacks has no key;
/// `required_tip_deg`, `before` and `after` are of the first standing pose, `poses` lists every pose.
std::string to_json(const Report& report);

/// An entry of `poses`, the number-th of them (from 1 on), on one line.
std::string to_json(const PoseReport& pose, std::size_t number);

/// "already_stands", "stands", "best_effort" or "falls".
std::string to_string(Outcome outcome);

}  // namespace aplomb
