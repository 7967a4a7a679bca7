#pragma once

#include <filesystem>

namespace aplomb::cli {

/// From now on Ctrl-C (and SIGTERM) makes interrupted() true; if the program has not ended 150 ms later, the pending
/// temporary file is removed and the program ends with `exit_code` on the spot.
void catch_interrupts(int exit_code);

/// The same after that time, with an exit code and a sentence of its own. \pre catch_interrupts() was called; seconds >
/// 0.
void limit_time(double seconds, int exit_code);

bool interrupted();
/// Whether it was the time that ended it.
bool is_over_time();

/// The temporary file to remove, or an empty path for none; for WriteOptions::on_temp_file.
void remember_temp_file(const std::filesystem::path& path);

/// What a handler does before it ends the program. Async-signal-safe.
void remove_temp_file();

}  // namespace aplomb::cli
