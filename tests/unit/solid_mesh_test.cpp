#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "aplomb/mesh/bodies.h"
#include "aplomb/mesh/solid_mesh.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

MeshDefects defects_of(const TriangleMesh& mesh) { return check_solid(mesh).value().defects; }

TriangleMesh without_triangle(TriangleMesh mesh, std::size_t index) {
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(index));
  return mesh;
}

TEST(CheckSolid, a_box_is_a_solid_of_one_body_with_its_volume) {
  const SolidCheck check = check_solid(test::box({0, 0, 0}, {10, 20, 30})).value();
  EXPECT_EQ(check.defects, MeshDefects{});
  ASSERT_TRUE(check.solid);
  EXPECT_EQ(check.solid->bodies(), 1U);
  EXPECT_EQ(check.solid->voids(), 0U);
  EXPECT_DOUBLE_EQ(check.solid->moments().volume_mm3, 6000);
}

TEST(CheckSolid, the_solid_keeps_the_triangles_and_rounds_to_float) {
  TriangleMesh box = test::box({0, 0, 0}, {10, 20, 30});
  for (Vec3& v : box.vertices) v.x += 0.1;
  const SolidCheck check = check_solid(box).value();
  ASSERT_TRUE(check.solid);
  EXPECT_EQ(check.solid->mesh(), rounded_to_float(box));
}

TEST(CheckSolid, every_coordinate_is_a_float_whatever_the_number_of_vertices) {
  for (int segments = 3; segments < 20; ++segments) {
    const SolidCheck check = check_solid(test::cone({0.1, 0.2, 0.3}, 1.7, 3.3, segments)).value();
    for (const Vec3& v : check.solid.value().mesh().vertices)
      for (int axis = 0; axis < 3; ++axis) {
        volatile float rounded = static_cast<float>(v[axis]);
        EXPECT_EQ(v[axis], static_cast<double>(rounded));
      }
  }
}

TEST(CheckSolid, vertices_that_no_triangle_uses_change_nothing) {
  TriangleMesh box = test::box({0, 0, 0}, {1, 1, 1});
  box.vertices.push_back({100, 100, 100});
  const SolidCheck check = check_solid(box).value();
  ASSERT_TRUE(check.solid);
  EXPECT_EQ(check.solid->mesh(), test::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(check.solid->box().max.x, 1);
}

TEST(CheckSolid, a_missing_triangle_leaves_three_open_edges) {
  EXPECT_EQ(defects_of(without_triangle(test::box({0, 0, 0}, {1, 1, 1}), 3)), (MeshDefects{.open_edges = 3}));
}

TEST(CheckSolid, a_flipped_triangle_flips_its_three_edges) {
  TriangleMesh box = test::box({0, 0, 0}, {1, 1, 1});
  std::swap(box.triangles[5][0], box.triangles[5][1]);
  EXPECT_EQ(defects_of(box), (MeshDefects{.flipped_edges = 3}));
}

TEST(CheckSolid, a_doubled_triangle_is_a_duplicate_on_edges_of_three_triangles) {
  TriangleMesh box = test::box({0, 0, 0}, {1, 1, 1});
  const Triangle t = box.triangles[0];
  box.triangles.push_back({t[2], t[0], t[1]});
  EXPECT_EQ(defects_of(box), (MeshDefects{.nonmanifold_edges = 3, .duplicate_triangles = 1}));
}

TEST(CheckSolid, a_collinear_triangle_is_degenerate) {
  TriangleMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({0.5, 0.5, 5});
  mesh.vertices.push_back({0.5, 0.5, 6});
  mesh.vertices.push_back({0.5, 0.5, 8});
  mesh.triangles.push_back({8, 9, 10});
  EXPECT_EQ(defects_of(mesh), (MeshDefects{.open_edges = 3, .degenerate_triangles = 1}));
}

TEST(CheckSolid, two_boxes_that_cross_intersect_themselves) {
  const auto mesh = joined(test::box({0, 0, 0}, {2, 2, 2}), test::box({1, 1, 1}, {3, 3, 3}));
  const MeshDefects defects = defects_of(mesh);
  EXPECT_GT(defects.self_intersections, 0U);
  EXPECT_EQ(defects, (MeshDefects{.self_intersections = defects.self_intersections}));
}

TEST(CheckSolid, two_boxes_that_touch_at_a_corner_edge_or_face_intersect) {
  for (const Vec3 shift : {Vec3{1, 1, 1}, Vec3{1, 1, 0}, Vec3{1, 0, 0}, Vec3{1, 0.5, 0.25}}) {
    const auto mesh = joined(test::box({0, 0, 0}, {1, 1, 1}), test::box(shift, shift + Vec3{1, 1, 1}));
    EXPECT_GT(defects_of(mesh).self_intersections, 0U);
  }
}

TEST(CheckSolid, boxes_that_share_a_vertex_are_nonmanifold_there) {
  TriangleMesh mesh = joined(test::box({0, 0, 0}, {1, 1, 1}), test::box({1, 1, 1}, {2, 2, 2}));
  const auto find = [&](std::size_t from) {
    return static_cast<std::uint32_t>(std::find(mesh.vertices.begin() + from, mesh.vertices.end(), Vec3{1, 1, 1}) -
                                      mesh.vertices.begin());
  };
  const std::uint32_t first = find(0), second = find(8);
  for (Triangle& t : mesh.triangles) std::replace(t.begin(), t.end(), second, first);
  EXPECT_EQ(defects_of(mesh), (MeshDefects{.nonmanifold_vertices = 1}));
}

TEST(CheckSolid, a_folded_edge_overlaps_itself) {
  // Two triangles over the same edge, both on the same side of it in one plane.
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.5, 0}}, {{0, 1, 2}, {1, 0, 3}}};
  EXPECT_EQ(defects_of(mesh).self_intersections, 1U);
}

TEST(CheckSolid, a_vertex_that_touches_a_distant_triangle_by_one_ulp_is_seen) {
  const float z = 1.0F;
  const auto with_tip = [&](float tip) {
    return joined(test::tetrahedron({0, 0, z}, {3, 0, z}, {0, 3, z}, {0, 0, 4}),
                  test::tetrahedron({0.5, 0.5, tip}, {0, 0, -2}, {1, 0, -2}, {0, 1, -2}));
  };
  EXPECT_GT(defects_of(with_tip(z)).self_intersections, 0U);
  EXPECT_EQ(defects_of(with_tip(std::nextafter(z, 0.0F))), MeshDefects{});
}

TEST(CheckSolid, a_nested_shell_wound_inward_is_a_void) {
  const auto mesh = test::with_void(test::box({0, 0, 0}, {4, 4, 4}), test::sphere({2, 2, 2}, 1, 2));
  const SolidCheck check = check_solid(mesh).value();
  ASSERT_TRUE(check.solid);
  EXPECT_EQ(check.solid->bodies(), 1U);
  EXPECT_EQ(check.solid->voids(), 1U);
  EXPECT_LT(check.solid->moments().volume_mm3, 64);
}

TEST(CheckSolid, every_wrong_nesting_is_a_misoriented_shell) {
  const TriangleMesh outer = test::box({0, 0, 0}, {9, 9, 9}), inner = test::box({3, 3, 3}, {6, 6, 6});
  EXPECT_EQ(defects_of(reversed(outer)).misoriented_shells, 1U);
  EXPECT_EQ(defects_of(joined(outer, inner)).misoriented_shells, 1U);
  EXPECT_EQ(defects_of(joined(reversed(outer), reversed(inner))).misoriented_shells, 2U);
  EXPECT_EQ(defects_of(joined(outer, reversed(test::box({10, 3, 3}, {11, 4, 4})))).misoriented_shells, 1U);
}

TEST(CheckSolid, a_body_inside_a_void_is_a_body) {
  TriangleMesh mesh = test::with_void(test::box({0, 0, 0}, {9, 9, 9}), test::box({1, 1, 1}, {8, 8, 8}));
  const SolidCheck check = check_solid(joined(mesh, test::box({3, 3, 3}, {6, 6, 6}))).value();
  ASSERT_TRUE(check.solid);
  EXPECT_EQ(check.solid->bodies(), 2U);
  EXPECT_DOUBLE_EQ(check.solid->moments().volume_mm3, 729 - 343 + 27);
}

TEST(CheckSolid, its_prints_are_those_that_are_told_of_any_mesh) {
  TriangleMesh whole = reversed(test::box({2, 2, 2}, {8, 8, 8}));  // a void comes first, then what is in it
  whole = joined(std::move(whole), test::box({4, 4, 4}, {6, 6, 6}));
  whole = joined(std::move(whole), test::box({20, 0, 0}, {30, 10, 10}));
  whole = joined(std::move(whole), test::box({0, 0, 0}, {10, 10, 10}));
  const SolidCheck check = check_solid(whole).value();
  ASSERT_TRUE(check.solid);
  EXPECT_EQ(check.prints.count, 2U);
  const PrintNumbers told = number_prints(whole).value();
  EXPECT_EQ(check.prints.count, told.count);
  EXPECT_EQ(check.prints.of_triangle, told.of_triangle);
  EXPECT_EQ(check_solid(without_triangle(whole, 0)).value().prints.count, 0U);  // no solid has none
}

TEST(CheckSolid, neither_order_nor_turning_the_corners_changes_the_defects) {
  TriangleMesh mesh = joined(test::sphere({0, 0, 0}, 3, 3), test::torus({1, 0, 0}, 3, 1, 24, 12));
  mesh.triangles.resize(mesh.triangles.size() - 7);
  const MeshDefects before = defects_of(mesh);
  std::mt19937 random(3);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  for (Triangle& t : mesh.triangles) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
  EXPECT_EQ(defects_of(mesh), before);
  EXPECT_GT(before.self_intersections, 0U);
}

TEST(CheckSolid, an_empty_mesh_and_an_endless_one_are_unusable) {
  EXPECT_EQ(check_solid({}).error().code, ErrorCode::unusable_input);
  EXPECT_EQ(check_solid(test::box({0, 0, 0}, {1e39, 1, 1})).error().code, ErrorCode::unusable_input);
}

TEST(CheckSolid, stops_when_the_caller_says_so) {
  const Job stop([](double, std::string_view) { return false; });
  EXPECT_EQ(check_solid(test::sphere({}, 1, 3), stop).error().code, ErrorCode::cancelled);
}

TEST(CheckSolid, defects_are_described_in_words) {
  EXPECT_EQ(describe(MeshDefects{}), "no defect");
  EXPECT_EQ(describe({.open_edges = 1, .self_intersections = 3}), "1 open edge, 3 self-intersections");
}

}  // namespace
}  // namespace aplomb
