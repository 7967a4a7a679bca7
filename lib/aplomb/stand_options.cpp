#include "aplomb/stand_options.h"

#include <fmt/format.h>

#include <algorithm>

namespace aplomb {

namespace {

std::string find_insert_problem(const StandOptions& o) {
  if (o.inserts.empty()) return {};
  for (const InsertStock& stock : o.inserts)
    if (std::string problem = find_problem(stock); !problem.empty()) return problem;
  return {};
}

}  // namespace

std::string find_problem(const StandOptions& o) {
  if (std::string problem = find_problem(o.poses); !problem.empty()) return problem;
  if (!(o.density_g_per_cm3 > 0 && o.density_g_per_cm3 < 30))
    return fmt::format("density_g_per_cm3 is {}; it must lie in (0, 30)", o.density_g_per_cm3);
  if (!(o.wall_mm > 0 && o.wall_mm <= 1e4)) return fmt::format("wall_mm is {}; it must lie in (0, 10000]", o.wall_mm);
  if (o.voxel_mm)
    if (std::string problem = find_problem(VolumeOptions{o.wall_mm, *o.voxel_mm, o.least_void_mm, o.memory_bytes});
        !problem.empty())
      return problem;
  if (std::string problem = find_problem(o.reshape); !problem.empty()) return problem;
  if (o.deform == Deform::never && !o.reshape.regions.handles.empty())
    return "deform is never, but a handle moves the outside; it must be auto or only";
  if (std::string problem = find_problem(o.judge); !problem.empty()) return problem;
  if (std::string problem = find_insert_problem(o); !problem.empty()) return problem;
  return find_problem(CarveOptions{o.aim, 0, o.least_volume_mm3});
}

double voxel_mm(const StandOptions& options, const Box3& box) {
  return options.voxel_mm.value_or(std::min(options.wall_mm / 4, box.diagonal() / 256));
}

bool shapes_ceilings(const StandOptions& options) {
  const bool by_default = options.judge.rules.process() == Process::fdm;
  return options.ceiling ? *options.ceiling == Ceiling::automatic : by_default;
}

RowKind kind_of(const StandOptions& options) { return options.robust ? RowKind::robust : RowKind::nominal; }

}  // namespace aplomb
