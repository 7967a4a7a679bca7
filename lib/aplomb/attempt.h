#pragma once

#include <optional>

#include "aplomb/core/stage_clock.h"
#include "aplomb/holes/hole.h"
#include "aplomb/input.h"
#include "aplomb/report/report.h"
#include "aplomb/shell/shell.h"
#include "aplomb/stand_options.h"

// Steps of the pipeline between a solid and its shell; stand() chooses among them.

namespace aplomb {

/// One carving of one solid.
struct Attempt {
  JointProblem joint;
  Carving carving;
  std::optional<Shell> shell;               ///< where it reaches, or add_shell() was called; drilled where it has holes
  std::optional<SolidVolume> volume;        ///< that was carved
  std::optional<CeilingFigures> ceiling{};  ///< where ceilings were to be shaped and there is a shell
  std::vector<Hole> holes{};
  std::vector<std::string> hints{};
};

/// What a carving reckons with.
struct CarvingAllowance {
  Moments taken;          ///< of the material that will be taken besides the void
  double beyond_rad = 0;  ///< by which the angle asked for is to be exceeded at first
  bool always = false;    ///< a shell also of what does not reach
};

/// Carves and builds the shell; where simplifying it cost more than was aimed beyond, carves again for as much more.
/// \return as carve() and build_shell().
Result<Attempt> carve_shell(const SolidVolume& volume, const Input& input, const JointProblem& joint,
                            const StandOptions& options, const CarvingAllowance& allowance, StageClock& clock,
                            const Job& job);

/// Voxelises, carves and builds the shell, with the escape holes that the process asks for. \return as voxelize(),
/// joint_problem(), carve_shell(), with_printable_ceilings() and drained().
///
/// The shell is left out where the carving does not reach: see add_shell(). Ceilings are shaped where that is asked for
/// (with_printable_ceilings()), which may leave a carving short of what it reached.
Result<Attempt> attempt_carving(const Input& input, const StandOptions& options, StageClock& clock, const Job& job);

/// Builds the shell of a carving that does not reach, with escape holes and ceilings that print. \return as
/// attempt_carving().
Result<void> add_shell(Attempt& attempt, const Input& input, const StandOptions& options, StageClock& clock,
                       const Job& job);

/// A solid whose outside was changed, and what was made of it.
struct ReshapedAttempt {
  Input input;  ///< of the changed solid
  DeformationFigures figures;
  std::optional<Attempt> attempt;  ///< none when it is not to be carved
};

/// Changes the outside as little as it takes (Reshaper), then carves; what the final shell comes short of is asked for
/// in addition, twice at most. \return as Reshaper's functions and attempt_carving().
Result<ReshapedAttempt> attempt_reshaping(const Input& input, const StandOptions& options, StageClock& clock,
                                          const Job& job);

}  // namespace aplomb
