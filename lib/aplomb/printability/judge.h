#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aplomb/balance/pose.h"
#include "aplomb/balance/stability.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/stand_checks.h"

namespace aplomb {

struct RuleLimit {
  std::string id;
  double value = 0;
};

/// What a user changes of a process's rules.
struct RuleChanges {
  Process process = Process::fdm;
  std::vector<RuleLimit> limits{};
  std::vector<std::string> waived{};  ///< ids
  double layer_mm = 0.2;
};

/// \return invalid_option as Rules::set() and Rules::waive().
Result<Rules> rules_of(const RuleChanges& changes);

struct JudgeOptions {
  Rules rules{Process::fdm};
  std::optional<StandingPose> pose = StandingPose{};  ///< as it is printed and stands, up = +z; none: it does not stand
  Filling filling{};
  double density_g_per_cm3 = 1.24;  ///< in (0, 30); PLA
  std::vector<Region> body{};       ///< the print as its infill has it; empty: solid throughout, of that density
  std::vector<Region> inserts{};    ///< that lie in closed voids and weigh besides the print
  bool fem = false;                 ///< whether strength.fem is asked for, which takes seconds
};

/// A sentence that names field, value and range; empty when there is nothing to say.
std::string find_problem(const JudgeOptions& options);

/// Judges whether a mesh prints, as it lies on the plate: every check of the process by its definition, on the mesh
/// alone. Where the mesh is no solid only the mesh.* checks are made.
///
/// \param meant  what the mesh was to be, when it was read back from a file; for mesh.roundtrip.
/// \pre  find_problem(options) is empty.
/// \return unusable_input for a mesh without triangles; cancelled, over_budget, third_party.
Result<Judgement> judge(const TriangleMesh& mesh, const JudgeOptions& options, const TriangleMesh* meant = nullptr,
                        const Job& job = {});

}  // namespace aplomb
