#pragma once

#include <string>

#include "aplomb/job/job_file.h"
#include "solver/desk.h"
#include "solver/outbox.h"

namespace aplomb::studio {

/// As parse_job(), which refuses handles where nothing may bend: here they may pull all the same.
Result<JobFile> parse_bending_job(const std::string& text);

/// Bends the solid of a job towards its handles and its poses, telling of each stage, until that has settled.
/// \return cancelled; as Desk's functions and BendPreview::advance().
Result<void> preview(const JobFile& job, double wish, const Input& input, Desk& desk, Outbox& out);

}  // namespace aplomb::studio
