#pragma once

#include <array>
#include <optional>
#include <string>

#include "aplomb/core/error.h"
#include "aplomb/core/vec.h"
#include "aplomb/gcode/detail/command.h"

namespace aplomb::detail {

/// An arc about an axis along z.
struct Arc {
  Vec2 center_mm;
  double radius_mm = 0;
  double from_rad = 0;   ///< direction of the start, seen from the centre
  double sweep_rad = 0;  ///< counter-clockwise is positive
};

/// One move that laid down material.
struct Stroke {
  Vec3 from_mm, to_mm;       ///< of the nozzle
  std::optional<Arc> arc{};  ///< none: straight
  double feed = 0;           ///< > 0: mm of filament, or mm3 where is_volumetric
  bool is_volumetric = false;
  unsigned tool = 0;

  double length_mm() const;
  /// Centroid of the path, material lying along it evenly: the middle of a line; for an arc of sweep a about c, with u
  /// the direction of its middle, c + r (sin(a/2) / (a/2)) u.
  Vec3 centroid_mm() const;
};

/// What a printer makes of its commands: Marlin's, Klipper's and RepRapFirmware's reading where they agree; where they
/// do not, that of slicers' own previews: E is relative after M83, and after G91 whatever M82 said.
class Machine {
 public:
  static constexpr unsigned most_tools = 64;

  /// Obeys the command. What a retraction drew back is owed before anything counts as laid down; firmware retraction
  /// (G10, G11) moves no E. \return the stroke, if it laid down material; unusable_input for what cannot be read, such
  /// as a spline or an arc without a centre.
  Result<std::optional<Stroke>> obey(Command& command);

  unsigned tool() const { return tool_; }
  double flow_ratio() const { return flow_ratio_; }  ///< M221; feeds hold it already

 private:
  Result<std::optional<Stroke>> move(Command& command, int arc_direction);
  Result<std::optional<Arc>> arc_to(const Command& command, Vec3 to_mm, int direction) const;
  Vec3 target(const Command& command) const;
  double laid_down(double feed);
  void set_position(Command& command);
  void home(Command& command);
  void set_mode(Command& command);

  Vec3 at_mm_, origin_mm_;  // the nozzle, and what the program calls 0
  double e_ = 0;            // in the program's own numbers, mm or mm3
  bool is_relative_ = false, is_e_relative_ = false, is_volumetric_ = false;
  double unit_mm_ = 1, flow_ratio_ = 1;
  int plane_ = 17;
  unsigned tool_ = 0;
  std::array<double, most_tools> owed_{};
};

}  // namespace aplomb::detail
