#pragma once

#include <optional>
#include <string>

#include "aplomb/input.h"
#include "aplomb/job/job_file.h"

namespace aplomb::studio {

/// What the solver keeps between requests, so that the next answer comes at once.
class Desk {
 public:
  /// The solid of a job, from the file only where another one was asked for before. \return as load_solid().
  Result<const Input*> solid(const std::string& folder, const JobFile& asked, const Job& job);

  /// Names the solid that is there; another one has another name.
  const std::string& solid_key() const { return solid_key_; }

 private:
  std::string file_key_, solid_key_;
  std::optional<MeshFile> file_;
  std::optional<Input> solid_;
};

}  // namespace aplomb::studio
