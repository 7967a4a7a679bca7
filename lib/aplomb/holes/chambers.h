#pragma once

#include <optional>

#include "aplomb/carve/kept_parts.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// The wall that parts the chamber of a void round a point from its other chambers: a layer about the points as far
/// from the one as from the others, where they come nearer than 1.4 of the ball's diameter. Nothing where a ball of
/// that diameter gets everywhere. Chambers are what hangs together on a lattice of a sixth of the ball's diameter of
/// where it has room, for 0.8 to 1.2 of its diameter: the least that has several.
///
/// \param surface  closed, wound outward from the void; its coordinates are float32 values.
/// \par Cost  about 2 us for each point of the lattice in the void's box.
std::optional<KeptPart> wall_round_chamber(const TriangleMesh& surface, Vec3 inside_mm, double ball_mm,
                                           double thick_mm);

}  // namespace aplomb
