#include <string>

#include "aplomb/mesh/repair.h"

namespace aplomb {

std::string find_problem(const RepairOptions& options) {
  if (!(options.most_patched_ratio > 0 && options.most_patched_ratio <= 1))
    return "most_patched_ratio is " + std::to_string(options.most_patched_ratio) + ", not in (0, 1]";
  if (!(options.step_seconds >= 0 && options.step_seconds <= 3600))
    return "step_seconds is " + std::to_string(options.step_seconds) + ", not from 0 to 3600";
  if (options.step_memory_mb == 0) return "step_memory_mb is 0, not at least 1";
  if (options.remesh_voxels < 32 || options.remesh_voxels > 1000)
    return "remesh_voxels is " + std::to_string(options.remesh_voxels) + ", not from 32 to 1000";
  return {};
}

const char* name_of(RepairMethod method) {
  switch (method) {
    case RepairMethod::none:
      return "none";
    case RepairMethod::soup:
      return "soup";
    case RepairMethod::local:
      return "local";
    case RepairMethod::remeshed:
      return "remeshed";
  }
  return "";
}

}  // namespace aplomb
