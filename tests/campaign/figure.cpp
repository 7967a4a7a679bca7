#include "campaign/figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "aplomb/mesh/marching_tetrahedra.h"
#include "aplomb/mesh/placement.h"
#include "support/shapes.h"

namespace aplomb::campaign {
namespace {

bool has_box(const Limb& limb) { return limb.half_mm.x > 0; }

Mat3 turn_of(const Limb& limb) {
  return limb.turn_axis == Vec3{} ? Mat3{} : rotation_of({limb.turn_axis, limb.turn_rad});
}

double capsule_distance_mm(Vec3 at, Vec3 from, Vec3 step, double radius_mm) {
  const double length2 = squared_norm(step);
  const double along = length2 > 0 ? std::clamp(dot(at - from, step) / length2, 0.0, 1.0) : 0;
  return norm(at - from - along * step) - radius_mm;
}

double box_distance_mm(Vec3 at, Vec3 half) {
  const Vec3 beyond{std::abs(at.x) - half.x, std::abs(at.y) - half.y, std::abs(at.z) - half.z};
  const Vec3 out{std::max(beyond.x, 0.0), std::max(beyond.y, 0.0), std::max(beyond.z, 0.0)};
  return norm(out) + std::min(0.0, std::max({beyond.x, beyond.y, beyond.z}));
}

double noise(Vec3 at, double length_mm) {
  const double k = 2 * std::numbers::pi / length_mm;
  return std::sin(k * at.x + 0.3) * std::sin(k * at.y + 1.1) * std::sin(k * at.z + 2.3) +
         0.5 * std::sin(2.3 * k * at.x + k * at.z);
}

/// Negative inside; not a distance where there is noise or limbs overlap.
double field(const Figure& figure, double floor_mm, Vec3 at) {
  double value = 1e9;
  Vec3 from{};
  for (const Limb& limb : figure.limbs) {
    value = std::min(value, capsule_distance_mm(at, from, limb.step_mm, limb.radius_mm));
    from += limb.step_mm;
    if (has_box(limb)) value = std::min(value, box_distance_mm(transposed(turn_of(limb)) * (at - from), limb.half_mm));
  }
  if (figure.noise_mm > 0) value += figure.noise_mm * noise(at, figure.noise_length_mm);
  return std::max(value, floor_mm - at.z);
}

/// Every cell of the lattice over the figure's box; positive on its rim.
TriangleMesh polygonized(const Figure& figure) {
  const Box3 box = box_of(figure);
  const double cell = figure.cell_mm, margin = cell + 2 * figure.noise_mm;
  const Vec3 origin = box.min - Vec3{margin, margin, margin};
  std::array<int, 3> points{};
  for (int axis = 0; axis < 3; ++axis) points[axis] = static_cast<int>((box.size()[axis] + 2 * margin) / cell) + 2;
  // The lowest point is the first limb's or lower; what is cut off may not be all of it.
  const double floor_mm = figure.foot_mm > 0 ? box.min.z + figure.foot_mm : box.min.z - 2 * margin;
  std::vector<float> values;
  for (int k = 0; k < points[2]; ++k)
    for (int j = 0; j < points[1]; ++j)
      for (int i = 0; i < points[0]; ++i) {
        const double value = field(figure, floor_mm, origin + cell * Vec3{double(i), double(j), double(k)});
        const bool is_rim =
            i == 0 || j == 0 || k == 0 || i + 1 == points[0] || j + 1 == points[1] || k + 1 == points[2];
        const double off_zero = std::abs(value) < 1e-3 * cell ? 1e-3 * cell : value;
        values.push_back(static_cast<float>(is_rim ? std::max(off_zero, 0.1 * cell) : off_zero));
      }
  std::vector<CornerCell> cells;
  for (int k = 0; k + 1 < points[2]; ++k)
    for (int j = 0; j + 1 < points[1]; ++j)
      for (int i = 0; i + 1 < points[0]; ++i) {
        CornerCell corner_cell{{i, j, k}, {}};
        for (int c = 0; c < 8; ++c)
          corner_cell.values[c] = values[((k + (c >> 2 & 1)) * points[1] + j + (c >> 1 & 1)) * points[0] + i + (c & 1)];
        const auto [least, most] = std::minmax_element(corner_cell.values.begin(), corner_cell.values.end());
        if (*least < 0 && *most > 0) cells.push_back(corner_cell);
      }
  return marching_tetrahedra(cells, cell, origin);
}

Mat3 turn_onto(Vec3 from, Vec3 onto) {
  const Vec3 axis = cross(from, onto);
  const double angle = std::atan2(norm(axis), dot(from, onto));
  return rotation_of({norm(axis) > 1e-9 ? axis : Vec3{1, 0, 0}, angle});
}

TriangleMesh crossing(const Figure& figure) {
  TriangleMesh all;
  Vec3 at{};
  for (const Limb& limb : figure.limbs) {
    const double length = norm(limb.step_mm);
    if (length > 1) {
      const TriangleMesh rod = test::cylinder({0, 0, -limb.radius_mm}, limb.radius_mm, length + 2 * limb.radius_mm, 11);
      all = joined(std::move(all), transformed(rod, {turn_onto({0, 0, 1}, limb.step_mm / length), at}));
    }
    at += limb.step_mm;
    if (has_box(limb))
      all = joined(std::move(all), transformed(test::box(-limb.half_mm, limb.half_mm), {turn_of(limb), at}));
  }
  return all;
}

}  // namespace

Box3 box_of(const Figure& figure) {
  Box3 box;
  Vec3 at{};
  const auto add = [&](double reach) {
    box.add(at - Vec3{reach, reach, reach});
    box.add(at + Vec3{reach, reach, reach});
  };
  for (const Limb& limb : figure.limbs) {
    add(limb.radius_mm);
    at += limb.step_mm;
    add(std::max(limb.radius_mm, norm(limb.half_mm)));
  }
  return box;
}

TriangleMesh mesh_of(const Figure& figure) { return figure.is_crossing ? crossing(figure) : polygonized(figure); }

}  // namespace aplomb::campaign
