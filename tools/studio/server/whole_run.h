#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "server/models.h"
#include "server/resident.h"

namespace aplomb::studio {

/// The job of a page as a file has it: which model, and what is to be written. Nothing else is changed.
/// \pre `job` is a JSON object.
std::string job_file_text(const std::string& job, const Model& model, bool with_output, bool with_dense);

/// What a run of `aplomb` left in its folder.
struct Made {
  std::filesystem::path folder;
  std::string stem;  ///< of the model

  std::filesystem::path report() const { return folder / (stem + "-report.json"); }
  std::filesystem::path page() const { return folder / (stem + "-report.html"); }
  std::filesystem::path mesh() const { return folder / (stem + "-standing.3mf"); }
  std::filesystem::path stl() const { return folder / (stem + "-standing.stl"); }
  std::filesystem::path dense() const { return folder / (stem + "-dense.stl"); }  ///< where ballast was made
};

/// Runs the program on a job in a folder of its own, telling the stream of progress and of what came out.
/// \return what it left, where it ran to its end; whether that stands or not.
std::optional<Made> run_whole(const std::filesystem::path& program, const std::filesystem::path& folder,
                              const Model& model, const std::string& job, Stream& stream, Resident& resident);

}  // namespace aplomb::studio
