#pragma once

#include <string>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/ending.h"
#include "aplomb/io/read_mesh.h"
#include "aplomb/job/job_file.h"
#include "aplomb/mesh/triangle_mesh.h"

// What the C library's working calls do, in C++: the same steps as the program's, without files.

namespace aplomb::capi {

struct Finished {
  Ending ending = Ending::internal;
  std::string message;  ///< for people
  std::string report;   ///< JSON
  TriangleMesh mesh;    ///< empty where there is none to give out
};

/// What a job may be asked for. \return what the steps return.
using Run = Result<Finished>(const MeshFile& file, const JobFile& job, const Job& listener);

Run run_stand, run_check, run_validate;

/// The job of a text in which the keys that name files are missing. \return invalid_option as parse_job(), and for such
/// a key.
Result<JobFile> job_without_files(const std::string& text);

}  // namespace aplomb::capi
