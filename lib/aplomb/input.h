#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aplomb/balance/stability.h"
#include "aplomb/core/stage_clock.h"
#include "aplomb/io/read_mesh.h"
#include "aplomb/mesh/placement.h"
#include "aplomb/mesh/repair.h"

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
  std::vector<Region> inserts{};   ///< that lie in voids of the solid, and weigh besides it
  Affine3 from_file{};             ///< takes what was read, in mm, to where it was placed
};

/// Told what each stage made, for those who want to look: a name such as "2-solid" and the mesh.
using StageViewer = std::function<void(std::string_view name, const TriangleMesh& mesh)>;

/// Reads a file, chooses one print and places it, as it is.
///
/// \return what read_mesh(), number_prints() and place() return; invalid_option when there is no such print.
Result<TriangleMesh> load_print(const std::filesystem::path& path, const InputOptions& options, const Job& job = {});

/// The same of what was read already, or never was in a file.
Result<TriangleMesh> load_print(const MeshFile& file, const InputOptions& options, const Job& job = {});

/// Reads a file, chooses one print, places it and makes a solid of it.
///
/// \return what read_mesh(), split_prints(), place() and repair() return; unusable_input when the file holds several
///         prints, with their numbers and sizes, and none was chosen.
Result<Input> load_solid(const std::filesystem::path& path, const InputOptions& options, const Job& job = {},
                         const StageViewer& view = {});

/// The same of what was read already, or never was in a file.
Result<Input> load_solid(const MeshFile& file, const InputOptions& options, const Job& job = {},
                         const StageViewer& view = {});

}  // namespace aplomb
