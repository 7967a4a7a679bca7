#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "aplomb/balance/standing.h"
#include "aplomb/core/stage_clock.h"

namespace aplomb {

enum class Outcome {
  already_stands,  ///< as it came, at the angle asked for
  stands,          ///< it does now
  best_effort,     ///< it does not; the nearest that could be reached
  falls,           ///< it does not, and only that was asked (`check`)
};

struct CarvingFigures {
  std::string aim;  ///< "least", "light" or "stable"
  double void_mm3 = 0;
  double bound_rad = 0;    ///< no void in this volume gives a larger tip angle
  double gap_rad = 0;      ///< bound less what was reached
  std::size_t planes = 0;  ///< tried until it was proved
};

struct WallFigures {
  double required_mm = 0;
  double measured_mm = 0;  ///< exact, on the rounded output
};

struct MeshFigures {
  bool outer_unchanged = false;
  bool closed = false;
  std::size_t self_intersections = 0;
  std::size_t voids = 0;
  std::size_t triangles = 0;
};

/// What a run found and did, measured on what it wrote. A part that the run had no use for is absent.
struct Report {
  std::string version;
  Outcome outcome = Outcome::falls;
  double required_tip_rad = 0;
  Standing before;
  std::optional<Standing> after;
  std::optional<CarvingFigures> carving;
  std::optional<WallFigures> wall;
  std::optional<MeshFigures> mesh;
  std::vector<std::string> repair;  ///< what was wrong with the input and what was decided, a sentence each
  std::vector<std::string> hints;   ///< what looks like a mistake, or what would help, a sentence each
  StageSeconds stage_seconds;
  double peak_memory_mb = 0;
  std::vector<std::pair<std::string, std::variant<bool, double, std::string>>> options;
};

}  // namespace aplomb
