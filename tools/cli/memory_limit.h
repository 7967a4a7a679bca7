#pragma once

#include <cstddef>

namespace aplomb::cli {

/// From now on, where the process holds more memory than that of its own (files and libraries aside), the pending
/// temporary file is removed and the program ends with `exit_code` on the spot. Looks a hundred times a second.
///
/// The kernel's own limit (RLIMIT_DATA) would be exact, but libraries crash at an allocation that fails. Children have
/// limits of their own: run_isolated(). Linux alone is looked at; elsewhere the estimates made before allocating are
/// all there is.
void limit_memory(std::size_t bytes, int exit_code);

}  // namespace aplomb::cli
