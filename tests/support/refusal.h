#pragma once

#include <string>
#include <string_view>

/// What people are promised of a file that is refused.
namespace aplomb::test {

/// What a refusal lacks; empty when it is one short line without control characters that begins with the file's name,
/// goes on with the place in it (but for what is true of the file as a whole) and ends in a remedy behind a semicolon.
std::string lack_of_refusal(std::string_view message, std::string_view file_name);

}  // namespace aplomb::test
