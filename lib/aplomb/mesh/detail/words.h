#pragma once

#include <cstddef>
#include <string>

#include "aplomb/core/vec.h"

/// Numbers as people read them in a report's sentences.
namespace aplomb::detail {

/// "1 hole", "3 holes".
std::string counted(std::size_t count, const char* one, const char* many);
/// "0.25 mm", "38 mm".
std::string length(double mm);
/// "4.5 %", "38 %".
std::string percent(double ratio);
/// What a solid's box says of parts that a repair lost, and the remedy; empty when it is as it was.
std::string lost_parts(const Box3& before, const Box3& after);

}  // namespace aplomb::detail
