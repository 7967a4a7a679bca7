#include <signal.h>

#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

#include "server/studio.h"
#include "solver/solver.h"

namespace {

constexpr int usage_exit = 1, internal_exit = 7;

int run(int argc, char** argv) {
  aplomb::studio::StudioOptions options;
  options.program = std::filesystem::read_symlink("/proc/self/exe");
  double most_upload_mb = 512;
  bool no_browser = false, is_solver = false;
  CLI::App app("Aplomb Studio: an editor in the browser for a figure that learns to stand.", "aplomb studio");
  app.set_version_flag("--version", "aplomb-studio " APLOMB_VERSION);
  app.add_option("FILE", options.given, "a model or a job file to begin with");
  app.add_option("--port", options.port, "of 127.0.0.1 (default: any that is free)")->check(CLI::Range(0, 65535));
  app.add_flag("--no-browser", no_browser, "only print the address");
  app.add_option("--max-upload", most_upload_mb, "largest file that the page may send, in MB (default 512)")
      ->check(CLI::Range(0.001, 1e9));
  app.add_flag("--solver", is_solver)->group("");  // hidden: what the server starts
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_exit;
  }
  if (is_solver) return aplomb::studio::run_solver();
  options.opens_browser = !no_browser;
  options.most_upload_bytes = static_cast<std::size_t>(most_upload_mb * (1 << 20));
  return aplomb::studio::run_studio(options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "aplomb: " << error.what() << '\n';
    return internal_exit;
  }
}
