#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "aplomb/balance/poses.h"
#include "aplomb/carve/carve.h"
#include "aplomb/deform/reshape.h"
#include "aplomb/fdm/print_profile.h"
#include "aplomb/inserts/insert.h"
#include "aplomb/printability/judge.h"

namespace aplomb {

/// Whether the outside may change.
enum class Deform {
  never,      ///< voids only: every triangle of the outside stays
  automatic,  ///< where no void serves
  only,       ///< and nothing is carved
};

/// Whether voids get the holes that the process asks for, so that what is in them gets out.
enum class Holes {
  automatic,  ///< where the process asks for any: sla, powder, binder
  none,
};

/// Whether voids are shaped so that their ceilings print.
enum class Ceiling {
  automatic,  ///< so that the judge's checks of ceilings pass
  any,        ///< as balance alone has them
};

/// Whether mass is moved by denser infill on one side, the outside and the inside staying as they are.
enum class Ballasting {
  never,
  automatic,  ///< where a profile has sparse infill, and voids where that does not serve
  only,
};

/// Below it dense infill has nothing to be printed on.
inline constexpr double least_ballast_ratio = 0.05;

struct StandOptions {
  std::vector<Pose> poses{Pose{}};  ///< all of them are to hold at once, each at its required angle; not empty
  bool robust = false;              ///< asked of the robust tip angles instead of the nominal ones
  CarveAim aim = CarveAim::least;
  Deform deform = Deform::never;
  ReshapeOptions reshape = {};  ///< its wall_mm and carves follow from the rest
  Holes holes = Holes::automatic;
  double wall_mm = 1.6;                 ///< > 0; four lines of a 0.4 mm nozzle
  std::optional<Ceiling> ceiling = {};  ///< none: automatic where the judge's process is fdm, any otherwise
  std::optional<double> voxel_mm = {};  ///< none: at least 4 voxels in the wall and about 256 on the diagonal
  double least_void_mm = 1;             ///< no void narrower, >= 0; nor narrower than an escape hole
  double least_volume_mm3 = 10;         ///< no void smaller, >= 0; nor than four balls as wide as an escape hole
  std::size_t memory_bytes = std::size_t{4} << 30;
  double density_g_per_cm3 = 1.24;  ///< > 0; PLA
  bool best_effort = false;         ///< make the shell also when it will not stand
  /// How it is sliced, z up; none: solid. Carving takes it as solid and asks in addition for what slicing loses.
  std::optional<PrintProfile> profile = {};
  Ballasting ballast = Ballasting::automatic;    ///< only: needs a profile
  std::optional<double> ballast_low_ratio = {};  ///< of the infill, at least least_ballast_ratio; none: the profile's
  double ballast_high_ratio = 1;                 ///< above the low one, at most 1
  /// What may be laid into pockets while it prints; carving follows where that is not enough.
  std::vector<InsertStock> inserts = {};
  JudgeOptions judge = {};  ///< of what is written; its pose is the first that stands as it is printed
};

/// A sentence that names field, value and range; empty when there is nothing to say.
std::string find_problem(const StandOptions& options);

/// The voxel that `options` ask for or that suits a solid of this size.
double voxel_mm(const StandOptions& options, const Box3& box);

/// In g/cm3: what the profile says, else the option.
double printed_density(const StandOptions& options);

/// Whether `options` ask for voids whose ceilings print.
bool shapes_ceilings(const StandOptions& options);

/// The rows that `options` ask for.
RowKind kind_of(const StandOptions& options);

}  // namespace aplomb
