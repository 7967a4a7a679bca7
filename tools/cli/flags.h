#pragma once

#include <CLI/CLI.hpp>

#include "arguments.h"

// The flags by what they are about. Each is bound to a field of the Arguments, which must outlive the app.

namespace aplomb::cli {

/// The model and how it is placed and repaired.
void add_input_flags(CLI::App* app, Arguments& a);

/// How it is to stand: what may touch, and the angle.
void add_standing_flags(CLI::App* app, Arguments& a, StandingPose& pose);

/// What it hangs from, and how level.
void add_hanging_flags(CLI::App* app, HangingPose& pose);

/// Wall, aim, grid and output of what is carved.
void add_carving_flags(CLI::App* app, Arguments& a);

/// Whether and how far the outside may change.
void add_reshaping_flags(CLI::App* app, Arguments& a);
void add_region_flags(CLI::App* app, Regions& regions);

/// What a print is judged by.
void add_judging_flags(CLI::App* app, Arguments& a);

/// How progress is told.
/// Of infill that is denser on one side.
void add_ballast_flags(CLI::App* app, Arguments& a);
void add_time_flag(CLI::App* app, Arguments& a);
void add_progress_flag(CLI::App* app, Arguments& a);

/// G-code, what is expected of it, and its filaments.
void add_verify_flags(CLI::App* app, Arguments& a);

/// The slicer's profile by which it is measured.
void add_profile_flag(CLI::App* app, Arguments& a);

/// Material, report, threads, memory, quiet: what every run has.
void add_run_flags(CLI::App* app, Arguments& a);

}  // namespace aplomb::cli
