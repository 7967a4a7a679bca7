#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/printed_solid.h"

namespace aplomb {

/// A way out of a cavity.
struct Opening {
  Vec3 at_mm;              ///< the middle of its narrowest place; of a bore, the end on the side of the cavity
  Vec3 along;              ///< outward, of length 1
  double diameter_mm = 0;  ///< of the largest ball that passes, at most 1.2 % below the true one
};

/// Empty space enclosed in a solid: by a closed shell of its own, or by the outer surface but for narrow openings.
struct Cavity {
  bool is_shell = false;  ///< no opening at all: a closed surface of its own
  double volume_mm3 = 0;  ///< of a shell exact, else to about a twentieth of the hole's diameter along the walls
  Box3 box_mm;
  Vec3 deepest_mm;          ///< farthest from the walls
  double clearance_mm = 0;  ///< that distance
  Vec3 lowest_mm, highest_mm;
  std::vector<Opening> openings;  ///< widest first; some that are too narrow for the hole, too

  /// How many openings let a ball of this diameter through.
  int holes(double hole_mm) const;
  bool is_closed(double hole_mm) const { return holes(hole_mm) == 0; }
};

/// Finds the cavities of a solid, by the clearance c of empty space (the radius of the largest ball round a point that
/// meets no material). With rho = hole_mm / 2, a part of empty space is a cavity when
/// - a ball of radius rho finds room in it: its largest clearance is P >= rho;
/// - every way out is narrow: the widest ways to the outside have clearances b <= P / 2 and b < 3 rho. What has a wider
///   opening is a cup or a vase, and needs no escape hole;
/// - it holds more than two balls of diameter hole_mm (less is a dimple of a scan).
/// Parts that a ball of radius rho passes between are one cavity. Closed shells count whatever their size. A cavity
/// that is nowhere twice as wide as hole_mm may be overlooked when its openings let the ball pass, and one narrower
/// than hole_mm all over is, unless it is a closed shell.
///
/// Clearances on a lattice of rho / 2, exact, with 26 neighbours: a way of clearance rho is never lost on it, for its
/// points lie within 0.44 rho of lattice points, and never made up, for the balls round neighbours of 0.57 rho
/// overlap. Basins of a watershed of the clearance are then parted where the widest way between them, followed on
/// finer lattices, is narrow.
///
/// \pre hole_mm > 0. \return Shells first, then by height. Errors: cancelled; over_budget for a solid too large for the
///      lattice. \par Cost  a distance (1 to 2 us) per rho^3 / 8 of what lies within 3 rho of the outer surface, shared
///      by the threads allowed, and 0.02 to 0.2 s per opening.
Result<std::vector<Cavity>> find_cavities(const PrintedSolid& printed, double hole_mm, const Job& job = {});

/// The cavities with closed surfaces of their own, lowest first. \par Cost  2 ms and O(n) each.
std::vector<Cavity> closed_shells(const PrintedSolid& printed);

}  // namespace aplomb
