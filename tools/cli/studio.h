#pragma once

namespace aplomb::cli {

/// Becomes the program aplomb-studio, which lies beside this one, with the arguments after `aplomb studio`.
/// \return the exit code where it is not there.
int become_studio(int argc, char** argv);

}  // namespace aplomb::cli
