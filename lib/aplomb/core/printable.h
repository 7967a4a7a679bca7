#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace aplomb {

/// Text from a file made fit for one line of a message: control characters (terminals obey some, ESC and its UTF-8
/// kin first of all) become '?', and what is longer than `most` bytes ends in "...".
std::string printable(std::string_view text, std::size_t most = 80);

}  // namespace aplomb
