#pragma once

#include <optional>
#include <string>

#include "server/uploads.h"

namespace aplomb::studio {

/// What a page works on.
struct Work {
  Upload model;
  std::optional<Upload> profile;  ///< of the slicer
  std::string job;                ///< as the page has it: a JSON object that names no files

  /// What the profile is called beside the model; empty: there is none.
  std::string profile_name() const;
};

/// Who reads a job.
enum class JobReader {
  solver,  ///< in the model's folder; writes nothing
  run,     ///< the program, in a folder of its own with model and profile; writes a 3MF, and ballast's volume
  person,  ///< takes it away and lays it beside model and profile; writes a 3MF
};

/// The job as a file has it: with the files that it reads and writes. Nothing else is changed.
std::string job_text(const Work& work, JobReader reader);

}  // namespace aplomb::studio
