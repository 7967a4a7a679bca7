#pragma once

#include "aplomb/printability/slices.h"
#include "support/shapes.h"
#include "support/solids.h"

/// Shapes as the checks of printability see them.
namespace aplomb::test {

struct Print {
  PrintedSolid printed;
  Slices slices;
};

/// \pre mesh bounds a solid.
Print print_of(const TriangleMesh& mesh, double layer_mm = 0.2);

/// The same convex, counter-clockwise outline at each offset, and straight sides between. \pre Offsets rise.
TriangleMesh tower(const std::vector<Vec2>& outline, const std::vector<Vec3>& offsets);

/// The strip between two lines of as many points (x, z), swept by depth_mm along y. Going along, the second line lies
/// on the right.
TriangleMesh strip(const std::vector<Vec2>& left, const std::vector<Vec2>& right, double depth_mm);

/// A closed profile (radius, height), counter-clockwise and off the axis, turned about the z axis.
TriangleMesh ring(const std::vector<Vec2>& profile, int segments);

}  // namespace aplomb::test
