#pragma once

#include <string>

#include "arguments.h"

namespace aplomb::cli {

/// A sentence where two outputs of a command are one file, so that the later would replace the earlier, where two go to
/// standard output, or where one but the mesh is the file that is read; empty otherwise. What is there and no file,
/// such as /dev/null, may be named as often as one likes.
std::string find_clash(const Arguments& arguments);

}  // namespace aplomb::cli
