#pragma once

#include <cstdint>
#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

// Figures that nobody drew: what a case of the campaign is made of.

namespace aplomb::campaign {

/// A limb from the end of the one before, with a box about its end where `half_mm` is not zero.
struct Limb {
  Vec3 step_mm;
  double radius_mm = 4;
  Vec3 half_mm{};    ///< of the box
  Vec3 turn_axis{};  ///< of the box; zero: as the axes lie
  double turn_rad = 0;
};

struct Figure {
  std::vector<Limb> limbs;
  double noise_mm = 0;         ///< by which the surface goes in and out
  double noise_length_mm = 8;  ///< from one bump to the next
  double foot_mm = 1;          ///< cut off the base, so that it lies flat; 0: none
  double cell_mm = 2;          ///< of the lattice on which the surface is made
  bool is_crossing = false;    ///< limbs as meshes of their own that cross each other, left to repair; without noise
};

/// Holds all of it, but for noise.
Box3 box_of(const Figure& figure);

/// The surface of the union: closed, outward-wound, its limbs connected.
TriangleMesh mesh_of(const Figure& figure);

}  // namespace aplomb::campaign
