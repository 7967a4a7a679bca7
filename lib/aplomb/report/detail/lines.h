#pragma once

// Private to the report's texts: how numbers and lines are written.

#include <string>
#include <string_view>

#include "aplomb/report/report.h"

namespace aplomb::detail {

std::string number(double value, int decimals);

/// A tip angle in degrees; a small negative one is not rounded to a standing 0.
std::string degrees(double angle_rad);

/// Three significant digits, or whole numbers above.
std::string figure(double value);

/// "(1.0, 2.0, 3.0) mm"
std::string point(Vec3 p);

/// A name in its column, and what is said of it.
std::string line(std::string_view name, const std::string& text);

/// Where the print pauses, what goes in, and what it does.
std::string lines_of(const InsertFigures& inserts);

}  // namespace aplomb::detail
