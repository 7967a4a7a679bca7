#include "aplomb/balance/support_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/shapes.h"

namespace aplomb {
namespace {

constexpr double pi = std::numbers::pi;

SupportPolygon support_of(const TriangleMesh& mesh, const StandingPose& pose = {}) {
  const Result<SupportPolygon> support = support_polygon(mesh, pose);
  EXPECT_TRUE(support.has_value()) << (support ? "" : support.error().message);
  return support.value_or(SupportPolygon{});
}

double farthest_corner_mm(const SupportPolygon& support) {
  double farthest = 0;
  for (const Vec2& corner : support.corners_mm) farthest = std::max(farthest, norm(corner));
  return farthest;
}

bool is_strictly_convex_and_counter_clockwise(const std::vector<Vec2>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i)
    if (cross(corners[(i + 1) % n] - corners[i], corners[(i + 2) % n] - corners[(i + 1) % n]) <= 0) return false;
  return n >= 3;
}

TEST(SupportPolygon, WidthIsThatOfTheBoxHoweverItIsTurned) {
  const TriangleMesh box = test::box({1, 2, 3}, {5, 8, 20});
  for (int turn = 0; turn < 180; ++turn) {
    const TriangleMesh turned = transformed(box, test::rotation({0, 0, 1}, turn * pi / 90));
    EXPECT_NEAR(support_of(turned).width_mm(), 4, 1e-9) << turn;
    EXPECT_NEAR(support_of(turned, {.up = {0, 0, -1}}).width_mm(), 4, 1e-9) << turn;
  }
}

TEST(SupportPolygon, OfABoxIsItsBase) {
  const SupportPolygon support = support_of(test::box({1, 2, 3}, {5, 8, 20}));
  EXPECT_EQ(support.corners_mm, (std::vector<Vec2>{{1, 2}, {5, 2}, {5, 8}, {1, 8}}));
  EXPECT_EQ(support.frame.plate_mm, 3);
  EXPECT_EQ(support.height_mm, 17);
  EXPECT_DOUBLE_EQ(support.area_mm2(), 24);
  EXPECT_DOUBLE_EQ(support.width_mm(), 4);
  EXPECT_EQ(support.corners_in_model_mm()[2], (Vec3{5, 8, 3}));
}

TEST(SupportPolygon, OfANarrowingShapeIsItsBaseAndOfAWideningOneItsSectionAtTheContactHeight) {
  const double base_area = 10.0 / 2 * std::sin(2 * pi / 20) * 2;
  EXPECT_NEAR(support_of(test::frustum({}, 5, 2, 8, 20)).area_mm2(), base_area * 25, 1e-9);
  const double radius_at_contact_height = 2 + 3 * 0.4 / 8;
  EXPECT_NEAR(support_of(test::frustum({}, 2, 5, 8, 20), {.contact_height_mm = 0.4}).area_mm2(),
              base_area * radius_at_contact_height * radius_at_contact_height, 1e-9);
}

TEST(SupportPolygon, OfABallIsTheCircleAtTheContactHeight) {
  const double r = 20, tau = 0.5, exact = std::sqrt(2 * r * tau - tau * tau);
  double previous_error = 1;
  for (const int subdivisions : {4, 5, 6}) {
    const SupportPolygon support = support_of(test::sphere({}, r, subdivisions), {.contact_height_mm = tau});
    const double error = exact - farthest_corner_mm(support);
    EXPECT_GT(error, 0);  // every chord lies inside the ball
    EXPECT_LT(error, 0.6 * previous_error);
    EXPECT_TRUE(is_strictly_convex_and_counter_clockwise(support.corners_mm));
    previous_error = error;
  }
  EXPECT_LT(previous_error, 0.01);
}

TEST(SupportPolygon, OfALyingTorusReachesTheCircleAtTheContactHeight) {
  const double major = 30, minor = 5, tau = 0.3, exact = major + std::sqrt(2 * minor * tau - tau * tau);
  const SupportPolygon support = support_of(test::torus({}, major, minor, 600, 400), {.contact_height_mm = tau});
  EXPECT_NEAR(farthest_corner_mm(support), exact, 2e-3);
  EXPECT_NEAR(support.area_mm2(), pi * exact * exact, 0.3);
}

TEST(SupportPolygon, CoversEveryFootOfAFigureInOnePolygon) {
  TriangleMesh legs;
  for (const Vec2 at : {Vec2{0, 0}, Vec2{10, 0}, Vec2{0, 10}})
    legs = joined(std::move(legs), test::box({at.x, at.y, 0}, {at.x + 1, at.y + 1, 5}));
  const SupportPolygon support = support_of(legs);
  EXPECT_EQ(support.corners_mm, (std::vector<Vec2>{{0, 0}, {11, 0}, {11, 1}, {1, 11}, {0, 11}}));
  EXPECT_DOUBLE_EQ(support.area_mm2(), 121 - 50);
}

TEST(SupportPolygon, IgnoresVerticesThatNoTriangleUses) {
  TriangleMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({50, 50, -50});
  EXPECT_EQ(support_of(mesh).corners_mm, support_of(test::box({0, 0, 0}, {1, 1, 1})).corners_mm);
}

TEST(SupportPolygon, IsTheSameForEveryAxisThatPointsUp) {
  const TriangleMesh mesh = test::frustum({0.5, -0.25, 1}, 4, 6, 9, 12);
  for (const Vec3 up : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}) {
    const PlateFrame frame = plate_frame(up, 0);
    TriangleMesh turned = mesh;
    for (Vec3& v : turned.vertices) v = v.x * frame.x_axis + v.y * frame.y_axis + v.z * frame.up;
    EXPECT_EQ(support_of(turned, {.up = up}).corners_mm, support_of(mesh).corners_mm);  // exact
  }
}

TEST(SupportPolygon, TakesOnlyTheFeetThatAreNamed) {
  const TriangleMesh feet = joined(test::box({0, 0, 0}, {2, 2, 5}), test::box({10, 0, 0}, {12, 2, 5}));
  const SupportPolygon support = support_of(feet, {.contacts = {{{11, 1, 0}, 3}}});
  EXPECT_EQ(support.corners_mm, (std::vector<Vec2>{{10, 0}, {12, 0}, {12, 2}, {10, 2}}));
}

TEST(SupportPolygon, OfANamedPatchInTheMiddleOfAFaceIsTheDisc) {
  const SupportPolygon support = support_of(test::box({-10, -10, 0}, {10, 10, 5}), {.contacts = {{{1, 2, 0.5}, 1.3}}});
  const double disc_radius = std::sqrt(1.3 * 1.3 - 0.25);
  EXPECT_GE(support.area_mm2(), 64 * std::sin(2 * pi / 128) * disc_radius * disc_radius - 1e-9);
  EXPECT_LE(support.area_mm2(), pi * disc_radius * disc_radius);
  for (const Vec2& corner : support.corners_mm) EXPECT_NEAR(norm(corner - Vec2{1, 2}), disc_radius, 1e-12);
}

TEST(SupportPolygon, OfAPatchOverAnEdgeIsTheDiscCutByTheBase) {
  const SupportPolygon support = support_of(test::box({0, -10, 0}, {10, 10, 5}), {.contacts = {{{0, 0, 0}, 2}}});
  EXPECT_NEAR(support.area_mm2(), pi * 4 / 2, 5e-3);
  for (const Vec2& corner : support.corners_mm) EXPECT_GE(corner.x, 0);
}

TEST(SupportPolygon, CountsNamedPointsThemselves) {
  const SupportPolygon support =
      support_of(test::box({0, 0, 0}, {10, 10, 5}),
                 {.contacts = {{{1, 1, 0}, 0}, {{9, 1, 0.05}, 0}, {{5, 8, 0}, 0}, {{5, 5, 5}, 0}}});
  EXPECT_EQ(support.corners_mm, (std::vector<Vec2>{{1, 1}, {9, 1}, {5, 8}}));
}

TEST(SupportPolygon, IsDegenerateWithFewerThanThreeContactsOrAllInLine) {
  const TriangleMesh mesh = test::box({0, 0, 0}, {10, 10, 5});
  const std::vector<Contact> in_line{{{1, 1, 0}, 0}, {{2, 2, 0}, 0}, {{7, 7, 0}, 0}};
  for (std::size_t count = 1; count <= 3; ++count) {
    const SupportPolygon support = support_of(mesh, {.contacts = {in_line.begin(), in_line.begin() + count}});
    EXPECT_TRUE(support.degenerate());
    EXPECT_EQ(support.corners_mm.size(), std::min<std::size_t>(count, 2));
    EXPECT_EQ(support.area_mm2(), 0);
    EXPECT_EQ(support.width_mm(), 0);
    EXPECT_EQ(support.edges().size(), 4u);
  }
}

TEST(SupportPolygon, SaysHowHighTheNamedContactsAre) {
  const TriangleMesh mesh = joined(test::box({0, 0, 0}, {2, 2, 5}), test::box({10, 0, 0.75}, {12, 2, 5}));
  const Result<SupportPolygon> support = support_polygon(mesh, {.contacts = {{{11, 1, 0.75}, 2}}});
  ASSERT_FALSE(support);
  EXPECT_EQ(support.error().code, ErrorCode::invalid_option);
  EXPECT_NE(support.error().message.find("0.75 mm above"), std::string::npos) << support.error().message;
  EXPECT_TRUE(support_polygon(mesh, {.contacts = {{{11, 1, 0.75}, 2}}, .contact_height_mm = 0.8}));
}

TEST(SupportPolygon, SaysWhenNamedContactsAreNotOnTheSurfaceAtAll) {
  const Result<SupportPolygon> support =
      support_polygon(test::box({0, 0, 0}, {2, 2, 5}), {.contacts = {{{100, 0, 0}, 1}}});
  ASSERT_FALSE(support);
  EXPECT_NE(support.error().message.find("no part of the surface"), std::string::npos) << support.error().message;
}

/// Square sides cross the contact height straight above the corners: twins, but for the rounding of the turn.
TEST(SupportPolygon, KeepsEveryCornerOfATurnedBoxWhereTwoPointsCoincideButForRounding) {
  for (int k = 0; k < 200; ++k) {
    const Affine3 turn = test::rotation({1, 2, 3.0 - 0.1 * k}, 0.7 + k);
    TriangleMesh box = test::box({0, 0, 0}, {20, 30, 50});
    for (Vec3& v : box.vertices) v = turn * v;
    EXPECT_NEAR(support_of(box, {.up = turn * Vec3{0, 0, 1}}).area_mm2(), 600, 1e-9) << k;
  }
}

TEST(SupportPolygon, WidthIsTheSmallestAltitude) {
  const SupportPolygon triangle = support_of(test::prism({{0, 0}, {6, 0}, {0, 8}}, 0, {0, 0, 1}));
  EXPECT_NEAR(triangle.width_mm(), 4.8, 1e-12);  // the altitude on the hypotenuse of a 6-8-10 triangle
  EXPECT_NEAR(support_of(test::cylinder({}, 5, 1, 60)).width_mm(), 10 * std::cos(pi / 60), 1e-12);
}

TEST(StandingPose, NamesTheFieldThatIsOutOfRange) {
  EXPECT_EQ(find_problem(StandingPose{}), "");
  EXPECT_NE(find_problem({.up = {0, 0, 2}}).find("up"), std::string::npos);
  EXPECT_NE(find_problem({.contacts = {{{}, -1}}}).find("radius_mm"), std::string::npos);
  EXPECT_NE(find_problem({.contact_height_mm = 0}).find("contact_height_mm is 0"), std::string::npos);
  EXPECT_NE(find_problem({.required_tip_rad = 1.6}).find("required_tip_rad"), std::string::npos);
  EXPECT_NE(find_problem({.xy_error_mm = -0.1}).find("xy_error_mm"), std::string::npos);
}

}  // namespace
}  // namespace aplomb
