#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aplomb/deform/bend_preview.h"
#include "aplomb/input.h"
#include "aplomb/job/job_file.h"

namespace aplomb::studio {

/// What the solver keeps between requests, so that the next answer comes at once.
class Desk {
 public:
  /// The solid of a job, from the file only where another one was asked for before. \return as load_solid().
  Result<const Input*> solid(const std::string& folder, const JobFile& asked, const Job& job);

  bool has_solid() const { return solid_.has_value(); }

  /// What bends that solid for the poses of a job, made where it is not there yet. \return as BendPreview::make().
  Result<const BendPreview*> bender(const Input& input, const StandOptions& options, const Job& job);

  std::vector<Vec3> bent;  ///< the cage of the last stage of that bender; empty: at rest

 private:
  std::string file_key_, solid_key_;
  std::optional<MeshFile> file_;
  std::optional<Input> solid_;
  std::string bender_key_;
  std::optional<BendPreview> bender_;
};

}  // namespace aplomb::studio
