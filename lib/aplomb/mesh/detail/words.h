#pragma once

#include <cstddef>
#include <string>

/// Numbers as people read them in a report's sentences.
namespace aplomb::detail {

/// "1 hole", "3 holes".
std::string counted(std::size_t count, const char* one, const char* many);
/// "0.25 mm", "38 mm".
std::string length(double mm);
/// "4.5 %", "38 %".
std::string percent(double ratio);

}  // namespace aplomb::detail
