#pragma once

#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb::test {

/// The fixture `elephant` with its feet drawn together under the middle of its body, so that it stands on little: its
/// heavy trunk and thin ears are what a careless energy folds down, sinks or swells.
TriangleMesh elephant_on_small_feet(double foot_ratio);

/// Which vertices belong to a part, told by where they are in elephant_on_small_feet().
bool is_trunk(Vec3 vertex);
bool is_left_ear(Vec3 vertex);
bool is_right_ear(Vec3 vertex);

}  // namespace aplomb::test
