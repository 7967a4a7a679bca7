#pragma once

#include <functional>

#include "aplomb/deform/deform_cage.h"

/// Cages whose solid is known exactly.
namespace aplomb::test {

struct CellCount {
  int x = 1, y = 1, z = 1;
};

/// A box of cells, each split into six tetrahedra around its diagonal (Kuhn's split).
TetMesh tet_box(Vec3 min, Vec3 max, CellCount cells);

/// Four samples a tetrahedron, which have its exact zeroth, first and second moments.
/// `carvable` gives the share that may be carved at a point.
std::vector<SolidSample> samples_of(const TetMesh& mesh, const std::function<double(Vec3)>& carvable);

/// The rows of standing on a convex counter-clockwise polygon on the plate z = 0.
BalanceProblem standing_on(const std::vector<Vec2>& polygon);

/// A bar of 20 x 20 x 60 mm that stands on the plate and leans by lean_mm in +x, all of it solid and carvable deeper
/// than 3 mm, its lowest vertices fixed. `cells` along x and y, three times as many along z.
CageProblem leaning_bar(double lean_mm, double required_tip_rad, int cells = 4);

/// The problem with everything turned about the z axis.
CageProblem turned_about_z(CageProblem problem, double angle_rad);

/// The least det F of all tetrahedra, and the largest.
struct VolumeRange {
  double least = 1, most = 1;
};
VolumeRange volume_range(const TetMesh& rest, const std::vector<Vec3>& vertices);

}  // namespace aplomb::test
