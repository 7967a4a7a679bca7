#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "aplomb/core/error.h"

namespace aplomb::campaign {

/// What came of a case.
struct CaseEnd {
  std::string outcome;     ///< of the report, or "refused": no solid could be made of the figure
  std::string wrong;       ///< a promise that our own checks found broken; empty
  bool is_carved = false;  ///< something was written that has a void
};

/// What may be spoilt in what was written, to see that a judge finds it.
enum class Spoil { nothing, hole, winding, wall, angle, bound, outcome };

/// Runs a case from figure to report and leaves NUMBER.stl and NUMBER.json, what is claimed of it, in the folder.
CaseEnd run_case(std::uint64_t number, const std::filesystem::path& folder, Spoil spoil);

}  // namespace aplomb::campaign
