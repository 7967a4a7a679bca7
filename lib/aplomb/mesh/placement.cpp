#include "aplomb/mesh/placement.h"

#include <array>
#include <cmath>
#include <numbers>

namespace aplomb {
namespace {

Box3 box_of_triangles(const TriangleMesh& mesh) {
  Box3 box;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) box.add(mesh.vertices[v]);
  return box;
}

bool is_positive(const std::optional<double>& value) { return !value || (std::isfinite(*value) && *value > 0); }

std::string not_positive(const char* field, double value) {
  return std::string(field) + " is " + std::to_string(value) + ", not above 0";
}

}  // namespace

std::optional<UpAxis> up_axis_named(const std::string& name) {
  constexpr std::array names{"x", "y", "z", "-x", "-y", "-z"};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (name == names[i]) return static_cast<UpAxis>(i);
  return std::nullopt;
}

std::string find_problem(const PlacementOptions& options) {
  if (!is_positive(options.unit_mm)) return not_positive("unit_mm", *options.unit_mm);
  if (!is_positive(options.scale)) return not_positive("scale", *options.scale);
  if (!is_positive(options.height_mm)) return not_positive("height_mm", *options.height_mm);
  for (const AxisTurn& turn : options.turns) {
    if (!std::isfinite(turn.angle_rad)) return "angle_rad of a turn is not a finite number";
    const double length = norm(turn.axis);
    if (!std::isfinite(length) || length == 0) return "the axis of a turn has no direction";
  }
  return {};
}

std::vector<AxisTurn> turns_about_xyz(Vec3 angles_rad) {
  return {{{1, 0, 0}, angles_rad.x}, {{0, 1, 0}, angles_rad.y}, {{0, 0, 1}, angles_rad.z}};
}

Mat3 rotation_of(const AxisTurn& turn) {
  const Vec3 n = normalized(turn.axis);
  const double quarters = turn.angle_rad / (std::numbers::pi / 2);
  const double whole = std::round(quarters);
  double c = std::cos(turn.angle_rad), s = std::sin(turn.angle_rad);
  if (std::abs(quarters - whole) < 1e-12 * std::max(1.0, std::abs(quarters))) {
    constexpr std::array<double, 4> sines{0, 1, 0, -1};
    const auto quarter = static_cast<std::size_t>(std::fmod(std::fmod(whole, 4) + 4, 4));
    s = sines[quarter];
    c = sines[(quarter + 1) % 4];
  }
  // Rodrigues: c I + s [n]x + (1 - c) n n^T.
  const auto row = [&](Vec3 unit) { return c * unit + s * cross(unit, n) + (1 - c) * dot(unit, n) * n; };
  return {{{row({1, 0, 0}), row({0, 1, 0}), row({0, 0, 1})}}};
}

Mat3 rotation_of(UpAxis up) {
  switch (up) {
    case UpAxis::x:
      return {{{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}}};
    case UpAxis::minus_x:
      return {{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}};
    case UpAxis::y:
      return {{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}};
    case UpAxis::minus_y:
      return {{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}};
    case UpAxis::z:
      return {};
    case UpAxis::minus_z:
      return {{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};
  }
  return {};
}

Result<Placed> place(const TriangleMesh& mesh, const PlacementOptions& options) {
  if (options.asks_nothing()) return Placed{mesh, {}};
  Mat3 linear = options.up ? rotation_of(*options.up) : Mat3{};
  for (const AxisTurn& turn : options.turns) linear = rotation_of(turn) * linear;
  double factor = options.unit_mm.value_or(1) * options.scale.value_or(1);
  if (options.height_mm) {
    const double height = box_of_triangles(transformed(mesh, {linear, {}})).size().z;
    if (!(height > 0))
      return fail(ErrorCode::unusable_input, "the model has no height, so height_mm cannot be given to it");
    factor = *options.height_mm / height;
  }
  linear = factor * linear;
  const Box3 box = box_of_triangles(transformed(mesh, {linear, {}}));
  const Affine3 transform{linear, {0, 0, box.empty() ? 0 : -box.min.z}};
  TriangleMesh placed = rounded_to_float(transformed(mesh, transform));
  if (!mesh.triangles.empty() && !std::isfinite(box_of_triangles(placed).diagonal()))
    return fail(ErrorCode::unusable_input, "the placed model is too large; give a smaller unit, scale or height");
  return Placed{std::move(placed), transform};
}

}  // namespace aplomb
