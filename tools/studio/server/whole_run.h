#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "server/resident.h"
#include "server/work.h"

namespace aplomb::studio {

/// What a run of `aplomb` left in its folder.
struct Made {
  std::filesystem::path folder;
  std::string stem;  ///< of the model

  std::filesystem::path job() const { return folder / (stem + "-job.json"); }
  std::filesystem::path report() const { return folder / (stem + "-report.json"); }
  std::filesystem::path page() const { return folder / (stem + "-report.html"); }
  std::filesystem::path mesh() const { return folder / (stem + "-standing.3mf"); }
  std::filesystem::path stl() const { return folder / (stem + "-standing.stl"); }
  std::filesystem::path dense() const { return folder / (stem + "-dense.stl"); }  ///< where ballast was made
};

/// What is to be run, and where.
struct RunOrder {
  std::filesystem::path program;  ///< the command line's
  Work work;
  Made made;  ///< to be; its folder is not yet there
};

/// Runs the program in a folder of its own, telling the stream of progress and of what came out.
/// \param on_written called as soon as the meshes are whole and may be taken; the run goes on to draw its page. Not
///        called where nothing was written.
/// \return whether it ran to its end; whether that stands or not.
bool run_whole(const RunOrder& order, Stream& stream, Resident& resident, const std::function<void()>& on_written);

}  // namespace aplomb::studio
