#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "aplomb/balance/poses.h"
#include "aplomb/carve/carve.h"
#include "aplomb/deform/reshape.h"
#include "aplomb/io/read_mesh.h"
#include "aplomb/mesh/placement.h"
#include "aplomb/mesh/repair.h"
#include "aplomb/printability/judge.h"
#include "aplomb/report/report.h"
#include "aplomb/shell/shell.h"

// The story of a run, from top to bottom. Each function is one step that a program calls; tools/cli is the example.

namespace aplomb {

struct InputOptions {
  ReadOptions read;
  std::optional<std::size_t> object;  ///< which of the file's prints, from 1; needed when there are several
  PlacementOptions placement;
  RepairOptions repair;
  bool hint_at_resting = true;  ///< note where the model seems to lie: for those who mean +z to be up
};

/// What a file holds, ready to be measured and carved.
struct Input {
  SolidMesh solid;
  Moments moments;  ///< of the solid; of the triangles as they came where only_crossings
  RepairReport repair;
  std::vector<std::string> notes;  ///< what was odd about the file, and what looks like a mistake
  StageSeconds stage_seconds;      ///< read and repair
};

/// Told what each stage made, for those who want to look: a name such as "2-solid" and the mesh.
using StageViewer = std::function<void(std::string_view name, const TriangleMesh& mesh)>;

/// Reads a file, chooses one print and places it, as it is.
///
/// \return what read_mesh() and place() return; invalid_option when there is no such print.
Result<TriangleMesh> load_print(const std::filesystem::path& path, const InputOptions& options, const Job& job = {});

/// Reads a file, chooses one print, places it and makes a solid of it.
///
/// \return what read_mesh(), place() and repair() return; unusable_input when the file holds several prints, with their
///         numbers and sizes, and none was chosen.
Result<Input> load_solid(const std::filesystem::path& path, const InputOptions& options, const Job& job = {},
                         const StageViewer& view = {});

/// Whether the outside may change.
enum class Deform {
  never,      ///< voids only: every triangle of the outside stays
  automatic,  ///< where no void serves
  only,       ///< and nothing is carved
};

struct StandOptions {
  std::vector<Pose> poses{Pose{}};  ///< all of them are to hold at once, each at its required angle; not empty
  bool robust = false;              ///< asked of the robust tip angles instead of the nominal ones
  CarveAim aim = CarveAim::least;
  Deform deform = Deform::never;
  ReshapeOptions reshape = {};          ///< its wall_mm and carves follow from the rest
  double wall_mm = 1.6;                 ///< > 0; four lines of a 0.4 mm nozzle
  std::optional<double> voxel_mm = {};  ///< none: at least 4 voxels in the wall and about 256 on the diagonal
  double least_void_mm = 1;             ///< no void narrower, >= 0
  double least_volume_mm3 = 10;         ///< no void smaller, >= 0
  std::size_t memory_bytes = std::size_t{4} << 30;
  double density_g_per_cm3 = 1.24;  ///< > 0; PLA
  bool best_effort = false;         ///< make the shell also when it will not stand
  JudgeOptions judge = {};          ///< of what is written; its pose is the first that stands as it is printed
};

/// A sentence that names field, value and range; empty when there is nothing to say.
std::string find_problem(const StandOptions& options);

/// The voxel that `options` ask for or that suits a solid of this size.
double voxel_mm(const StandOptions& options, const Box3& box);

struct StandRun {
  std::optional<Shell> shell;      ///< what to print; none when it cannot stand and no best effort was asked for
  std::optional<Carving> carving;  ///< none when it stands already
  Report report;                   ///< `after` and `mesh` are to be measured on what is written: see measure_output()
};

/// Makes a solid hold every pose (stand, or hang) by carving.
///
/// \pre  find_problem(options) is empty.
/// \return over_budget, cancelled, unusable_input; not being able to is an outcome in the report.
Result<StandRun> stand(const Input& input, const StandOptions& options, const Job& job = {},
                       const StageViewer& view = {});

/// How a solid holds its poses as it is.
Result<Report> check(const Input& input, const StandOptions& options, const Job& job = {});

/// Completes the report of a run by measuring what was written, after reading it back: `after`, `mesh`, `judgement`
/// and the outcome that the file's own triangles bear out.
///
/// \return internal when the file does not hold what was meant: other triangles, or a shell that is no solid.
Result<Report> measure_output(const TriangleMesh& written, const StandRun& run, const StandOptions& options,
                              const Job& job = {});

}  // namespace aplomb
