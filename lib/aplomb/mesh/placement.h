#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// Which of the file's directions points up.
enum class UpAxis { x, y, z, minus_x, minus_y, minus_z };

/// "x", "y", "z", "-x", "-y" or "-z"; nothing for any other text.
std::optional<UpAxis> up_axis_named(const std::string& name);

/// A right-handed turn about an axis through the origin.
struct AxisTurn {
  Vec3 axis{0, 0, 1};  ///< any length but zero
  double angle_rad = 0;
};

/// How the model is put on the plate. Nothing asked: it stays bit for bit as the file has it.
struct PlacementOptions {
  std::optional<UpAxis> up = {};         ///< turned to +z by quarter turns
  std::vector<AxisTurn> turns = {};      ///< after `up`, in this order, about the plate's fixed axes
  std::optional<double> unit_mm = {};    ///< millimetres that one unit of the file stands for; above 0
  std::optional<double> scale = {};      ///< times this; above 0
  std::optional<double> height_mm = {};  ///< scaled, last, to this height; above 0

  bool asks_nothing() const { return !up && turns.empty() && !unit_mm && !scale && !height_mm; }
};

/// A sentence naming field, value and range; empty when there is no problem.
std::string find_problem(const PlacementOptions& options);

/// The turns of `--rotate X,Y,Z`: about x, then y, then z, all fixed.
std::vector<AxisTurn> turns_about_xyz(Vec3 angles_rad);

/// Exact (entries 0, 1 and -1) for quarter turns about the coordinate axes.
Mat3 rotation_of(const AxisTurn& turn);
Mat3 rotation_of(UpAxis up);

struct Placed {
  TriangleMesh mesh;
  Affine3 transform;  ///< of the given model to the placed one
};

/// Turns, scales and sets the model down.
///
/// \pre  find_problem(options) is empty.
/// \post Nothing asked: mesh is the given one and the transform the identity. Else: coordinates are float32 values and
///       the lowest point is at z = 0; x and y keep their origin.
/// \return unusable_input when height_mm is asked of a model without height, or the result is too large for float32.
/// \par Cost  O(n).
Result<Placed> place(const TriangleMesh& mesh, const PlacementOptions& options);

}  // namespace aplomb
