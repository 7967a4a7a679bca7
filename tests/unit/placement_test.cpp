#include "aplomb/mesh/placement.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "aplomb/mesh/mass_properties.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

constexpr double quarter_rad = std::numbers::pi / 2;
constexpr std::array up_axes{UpAxis::x, UpAxis::y, UpAxis::z, UpAxis::minus_x, UpAxis::minus_y, UpAxis::minus_z};

TriangleMesh model() { return test::box({0.1, -7.3, 2.7}, {3.3, 4.1, 9.9}); }

TEST(Place, nothing_asked_changes_no_bit) {
  const Placed placed = place(model(), {}).value();
  EXPECT_EQ(placed.mesh, model());
  EXPECT_EQ(placed.transform * (Vec3{1.1, 2.2, 3.3}), (Vec3{1.1, 2.2, 3.3}));
}

TEST(Place, the_chosen_axis_points_up_exactly_and_nothing_is_mirrored) {
  for (const UpAxis up : up_axes) {
    Vec3 direction;
    const int axis = static_cast<int>(up);
    direction[axis % 3] = axis < 3 ? 1 : -1;
    EXPECT_EQ(rotation_of(up) * direction, (Vec3{0, 0, 1}));
    EXPECT_EQ(determinant(rotation_of(up)), 1);
  }
}

TEST(Place, a_placed_model_stands_on_the_plate_with_its_volume) {
  const double volume = moments(model()).volume_mm3;
  for (const UpAxis up : up_axes) {
    const Placed placed = place(model(), {.up = up}).value();
    EXPECT_EQ(bounding_box(placed.mesh).min.z, 0);
    EXPECT_NEAR(moments(placed.mesh).volume_mm3, volume, 1e-6 * volume);
    EXPECT_EQ(placed.mesh, rounded_to_float(placed.mesh));
  }
}

TEST(Place, quarter_turns_are_exact) {
  for (int quarters = -9; quarters <= 9; ++quarters)
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, -2, 0}, Vec3{0, 0, 3}}) {
      const Mat3 turn = rotation_of(AxisTurn{axis, quarters * quarter_rad});
      for (const Vec3& row : turn.rows)
        for (int i = 0; i < 3; ++i) EXPECT_EQ(row[i], std::round(row[i]));
      EXPECT_EQ(determinant(turn), 1);
    }
  const Mat3 about_z = rotation_of(AxisTurn{{0, 0, 1}, quarter_rad});
  EXPECT_EQ(about_z * (Vec3{1, 0, 0}), (Vec3{0, 1, 0}));
}

TEST(Place, a_turn_keeps_its_axis_and_all_lengths) {
  const AxisTurn turn{{1, 2, 3}, 0.7};
  const Mat3 m = rotation_of(turn);
  EXPECT_NEAR(norm(m * turn.axis - turn.axis), 0, 1e-14);
  EXPECT_NEAR(norm(m * Vec3{5, -1, 2}), norm(Vec3{5, -1, 2}), 1e-14);
  const Vec3 across = normalized(cross(turn.axis, {1, 0, 0}));
  EXPECT_NEAR(dot(m * across, across), std::cos(0.7), 1e-14);
  EXPECT_NEAR(dot(cross(across, m * across), normalized(turn.axis)), std::sin(0.7), 1e-14);
}

TEST(Place, turns_are_done_in_their_order_about_fixed_axes) {
  const Placed placed = place(model(), {.turns = turns_about_xyz({quarter_rad, quarter_rad, 0})}).value();
  // About x: y goes to z; then about y: z goes to x.
  EXPECT_EQ(Mat3{placed.transform.linear} * (Vec3{0, 1, 0}), (Vec3{1, 0, 0}));
}

TEST(Place, unit_scale_and_height_multiply_lengths) {
  const double height = bounding_box(model()).size().z;
  const auto height_of = [](const PlacementOptions& options) {
    return bounding_box(place(model(), options).value().mesh).size().z;
  };
  EXPECT_NEAR(height_of({.unit_mm = 25.4, .scale = 2}), 50.8 * height, 1e-4);
  EXPECT_NEAR(height_of({.up = UpAxis::x, .unit_mm = 25.4, .height_mm = 100}), 100, 1e-5);
}

TEST(Place, every_field_out_of_range_is_named) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, inf, nan}) {
    EXPECT_NE(find_problem(PlacementOptions{.unit_mm = bad}).find("unit_mm"), std::string::npos);
    EXPECT_NE(find_problem(PlacementOptions{.scale = bad}).find("scale"), std::string::npos);
    EXPECT_NE(find_problem(PlacementOptions{.height_mm = bad}).find("height_mm"), std::string::npos);
  }
  EXPECT_NE(find_problem({.turns = {{{0, 0, 0}, 1}}}), "");
  EXPECT_NE(find_problem({.turns = {{{0, 0, 1}, nan}}}), "");
  EXPECT_EQ(find_problem(PlacementOptions{}), "");
}

TEST(Place, a_flat_model_has_no_height_to_scale) {
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(place(flat, {.height_mm = 10}).error().code, ErrorCode::unusable_input);
  EXPECT_EQ(place(model(), {.scale = 1e39}).error().code, ErrorCode::unusable_input);
}

TEST(Place, up_axes_have_names) {
  EXPECT_EQ(up_axis_named("-y"), UpAxis::minus_y);
  EXPECT_EQ(up_axis_named("w"), std::nullopt);
}

}  // namespace
}  // namespace aplomb
