#pragma once

namespace aplomb::studio {

/// The resident child: reads requests from standard input and answers each on standard output, as README.md has it,
/// until its input ends. It keeps the solid of the last model, placed as last asked for. \return the exit code.
int run_solver();

}  // namespace aplomb::studio
