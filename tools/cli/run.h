#pragma once

#include "arguments.h"

namespace aplomb::cli {

/// Runs the command; talks on standard error. \return the exit code.
int run(const Arguments& arguments);

inline constexpr int cancelled_exit = 4;

}  // namespace aplomb::cli
