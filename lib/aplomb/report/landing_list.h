#pragma once

#include <string>
#include <vector>

#include "aplomb/balance/landing.h"

namespace aplomb {

/// The ways a solid can rest, a line each, numbered from 1: chance, tip angle, height of the centre of mass,
/// area it rests on and the --rotate that puts it so.
std::string to_text(const std::vector<Landing>& landings);

/// The same as JSON: `poses`, each with `up`, `chance`, `tip_deg`, `com_height_mm`, `area_mm2` and, for --rotate,
/// `rotate_deg`.
std::string to_json(const std::vector<Landing>& landings);

/// Angles about the fixed axes x, y and z, in this order, that turn `up` to +z; the one about z is 0.
/// \pre up is a unit vector.
Vec3 turns_upright_rad(Vec3 up);

}  // namespace aplomb
