#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "aplomb/balance/stability.h"
#include "aplomb/balance/support_polygon.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/core/vec.h"
#include "aplomb/gcode/feature.h"

namespace aplomb {

/// The filament of one tool.
struct Filament {
  unsigned tool = 0;
  double diameter_mm = 1.75;
  double density_g_per_cm3 = 1.24;  ///< PLA
  bool diameter_is_known = false, density_is_known = false;
};

struct GcodeOptions {
  std::vector<double> diameters_mm{};  ///< > 0, by tool, the last for all further ones; empty: as the program says
  std::vector<double> densities_g_per_cm3{};  ///< the same
  bool is_one{};                              ///< all objects are one: a model and an infill mesh of Cura's in it
};

/// A sentence that names the field, its value and its range, or nothing.
std::string find_problem(const GcodeOptions& options);

/// One object as it is printed, without supports, skirt, brim, prime tower and purge. Coordinates are the bed's.
struct PrintedObject {
  std::string name;             ///< as the slicer labels it; empty where nothing is labelled
  std::vector<Region> body;     ///< by tool; a bead counts in the middle of its height
  Box3 box_mm;                  ///< of the beads' middle lines, from the foot of the first layer to the top of the last
  SupportPolygon contact;       ///< the hull of its first layer's beads; degenerate where nothing can stand on it
  double contact_layer_mm = 0;  ///< height of that layer
  double bead_width_mm = 0;     ///< mean in that layer: E volume / (length x height)
  std::optional<SupportPolygon> with_brim{};  ///< the same with its brim, where there is one
};

struct LeftOut {
  std::string what;
  double mass_g = 0;
};

/// What a program prints.
struct PrintedPlate {
  std::string slicer;                  ///< name and version; empty where unknown
  std::vector<PrintedObject> objects;  ///< in the order in which they are begun
  std::vector<LeftOut> left_out;       ///< by feature, what is no part of any object
  std::vector<Filament> filaments;     ///< of the tools that extrude, by number
  double filament_mm = 0;              ///< of all tools
  std::vector<std::string> notes;      ///< what was assumed or looks odd, a sentence each
};

/// Reads a G-code program in one pass, in memory that does not grow with its length, only with its objects.
///
/// Mass is what E pushes out: for each move, density x pi/4 d^2 x (dE less what retractions are owed), lying evenly
/// along the move, arcs included: (m, sum m c) per object with c the path's exact centroid, lowered by half a layer.
///
/// \pre  find_problem(options) is empty.
/// \return file_system; unusable_input for what is no G-code (binary G-code, an archive, UTF-16), ends before its
///         slicer's last lines, lays nothing down, or cannot be read, with the line; over_budget beyond 10,000 objects
///         or 100,000 pairs of an object and a tool; cancelled.
/// \par Cost  O(bytes + objects x loops of brims, of which 4096 count).
Result<PrintedPlate> read_gcode(const std::filesystem::path& path, const GcodeOptions& options = {},
                                const Job& job = {});

}  // namespace aplomb
