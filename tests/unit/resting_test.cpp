#include "aplomb/balance/resting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/shapes.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::vector<RestingFace> faces_of(const TriangleMesh& mesh, double contact_height_mm = 0.1) {
  return resting_faces(mesh, moments(mesh), contact_height_mm).value();
}

TEST(RestingFaces, OfABoxAreItsSixSidesTheFlattestFirst) {
  const std::vector<RestingFace> faces = faces_of(test::box({0, 0, 0}, {10, 20, 40}));
  ASSERT_EQ(faces.size(), 6u);
  EXPECT_NEAR(std::abs(faces[0].up.x), 1, 1e-12);
  EXPECT_NEAR(faces[0].tip_rad, std::atan2(10.0, 5.0), 1e-12);
  EXPECT_NEAR(faces[0].area_mm2, 800, 1e-9);
  EXPECT_NEAR(std::abs(faces[5].up.z), 1, 1e-12);
  EXPECT_NEAR(faces[5].tip_rad, std::atan2(5.0, 20.0), 1e-12);
}

TEST(RestingFaces, AreTheConvexHullsNotTheSurfaces) {
  TriangleMesh stool = test::box({0, 0, 10}, {10, 10, 12});
  for (const Vec2 leg : {Vec2{0, 0}, Vec2{9, 0}, Vec2{0, 9}, Vec2{9, 9}})
    stool = joined(std::move(stool), test::box({leg.x, leg.y, 0}, {leg.x + 1, leg.y + 1, 10}));
  const std::vector<RestingFace> faces = faces_of(stool);
  EXPECT_EQ(faces.size(), 6u);
  for (const RestingFace& face : faces) EXPECT_GE(face.area_mm2, 99);
}

TEST(RestingFaces, LeaveOutTheBaseThatALeaningPrismFallsFrom) {
  for (const RestingFace& face : faces_of(test::leaning_prism(10, 10, 40, 20))) EXPECT_LT(std::abs(face.up.z), 0.99);
}

TEST(RestingFaces, TurnWithTheModel) {
  const TriangleMesh mesh = test::tetrahedron({0, 0, 0}, {30, 2, 0}, {4, 25, 1}, {12, 9, 20});
  const Affine3 turn = test::rotation({1, 2, 3}, 1);
  const std::vector<RestingFace> faces = faces_of(mesh), turned = faces_of(transformed(mesh, turn));
  ASSERT_EQ(faces.size(), turned.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    EXPECT_NEAR(turned[i].tip_rad, faces[i].tip_rad, 1e-9);
    EXPECT_NEAR(dot(turned[i].up, turn.linear * faces[i].up), 1, 1e-9);
  }
}

TEST(RestingFaces, OfFineMeshesAreThoseOfTheShape) {
  const TriangleMesh ring = test::torus({}, 30, 10, 400, 200);  // beyond the vertices that the hull takes
  const std::vector<RestingFace> faces = faces_of(ring);
  ASSERT_GE(faces.size(), 2u);
  EXPECT_NEAR(std::abs(faces[0].up.z), 1, 1e-3);
  EXPECT_NEAR(faces[0].tip_rad, std::atan2(30 + std::sqrt(20 * 0.1), 10), 0.02);
}

TEST(RestingFaces, AreRefusedForAFlatMesh) {
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_FALSE(resting_faces(flat, {1, {}}, 0.1));
}

/// Four legs with flat soles, a long belly and a head that sticks out, standing along +z.
TriangleMesh quadruped() {
  TriangleMesh figure = test::sphere({0, 0, 50}, 14, 3);
  for (Vec3& v : figure.vertices) v.x *= 2.5;
  figure = joined(std::move(figure), test::sphere({45, 0, 65}, 17, 3));
  for (const Vec2 leg : {Vec2{-30, -9}, Vec2{25, -9}, Vec2{-30, 4}, Vec2{25, 4}})
    figure = joined(std::move(figure), test::box({leg.x, leg.y, 0}, {leg.x + 5, leg.y + 5, 40}));
  return figure;
}

TEST(RestingHint, NamesTheAxisThatAFigureWasMadeToStandOn) {
  const TriangleMesh lying = transformed(quadruped(), test::rotation({1, 0, 0}, -90 * degree));  // its up is now y
  const std::optional<RestingHint> hint = resting_hint(lying, moments(lying), {.up = {0, 0, 1}});
  ASSERT_TRUE(hint && hint->up);
  EXPECT_EQ(*hint->up, (Vec3{0, 1, 0}));
  EXPECT_GT(hint->suggested_tip_rad, hint->given_tip_rad + 10 * degree);
}

TEST(RestingHint, IsSilentOnAFigureThatStands) { EXPECT_FALSE(resting_hint(quadruped(), moments(quadruped()), {})); }

TEST(RestingHint, IsSilentOnAFigureThatTopplesFromItsOwnFlatBase) {
  const TriangleMesh bust = test::leaning_prism(30, 20, 80, 40);
  EXPECT_FALSE(resting_hint(bust, moments(bust), {}));
}

TEST(RestingHint, DoesNotDependOnTheSize) {
  const TriangleMesh lying = transformed(quadruped(), test::scaling(1e-3) * test::rotation({1, 0, 0}, -90 * degree));
  EXPECT_TRUE(resting_hint(lying, moments(lying), {}));
  EXPECT_FALSE(resting_hint(lying, moments(lying), {.up = {0, 1, 0}}));
}

}  // namespace
}  // namespace aplomb
