#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace aplomb::studio {

struct StudioOptions {
  std::filesystem::path program;  ///< this one, which is the solver, too
  std::filesystem::path given;    ///< a model or a job to begin with; empty: none
  int port = 0;                   ///< 0: any that is free
  bool opens_browser = true;
  std::size_t most_upload_bytes = std::size_t{512} << 20;
};

/// Serves the page and its requests, as README.md has them, until it is told to end. \return the exit code.
int run_studio(const StudioOptions& options);

}  // namespace aplomb::studio
