#pragma once

#include <optional>

#include "aplomb/fdm/ballast.h"
#include "aplomb/holes/hole.h"
#include "aplomb/input.h"
#include "aplomb/report/report.h"
#include "aplomb/shell/shell.h"
#include "aplomb/stand_options.h"

// The story of a run, from top to bottom. Each function is one step that a program calls; tools/cli is the example.

namespace aplomb {

struct StandRun {
  std::optional<Shell> shell;          ///< what to print; none when it cannot stand and no best effort was asked for
  std::optional<Carving> carving;      ///< none when it stands already
  std::vector<Hole> holes;             ///< escape holes that were cut through the shell
  std::vector<Region> inserts;         ///< that lie in pockets of the shell: see report.inserts
  TriangleMesh undrilled;              ///< the outside before the holes were cut; empty without holes
  std::optional<LayeredPrint> layers;  ///< of the solid as it came, where there is a profile
  std::optional<Ballast> ballast;      ///< where mass was moved by infill; then `shell` is the solid as it came
  Report report;  ///< `after` and `mesh` are to be measured on what is written: see measure_output()
};

/// Makes a solid hold every pose (stand, or hang) by carving, or by infill (tries_ballast()).
///
/// \pre  find_problem(options) is empty.
/// \return over_budget, cancelled, unusable_input; not being able to is an outcome in the report.
Result<StandRun> stand(const Input& input, const StandOptions& options, const Job& job = {},
                       const StageViewer& view = {});

/// A plug for each escape hole of a run, laid where it belongs: see plugs(). The balance was solved without them.
/// \return cancelled, third_party where one cannot be made.
Result<std::vector<TriangleMesh>> hole_plugs(const StandRun& run, const Job& job = {});

/// How a solid holds its poses as it is.
Result<Report> check(const Input& input, const StandOptions& options, const Job& job = {});

/// Completes the report of a run by measuring what was written, after reading it back: `after`, `mesh`, `judgement`
/// and the outcome that the file's own triangles bear out.
///
/// \return internal when the file does not hold what was meant: other triangles, or a shell that is no solid.
Result<Report> measure_output(const TriangleMesh& written, const Input& input, const StandRun& run,
                              const StandOptions& options, const Job& job = {});

}  // namespace aplomb
