#include "aplomb/mesh/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "aplomb/mesh/bodies.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

TriangleMesh cube(double from = 0, double to = 10) { return test::box({from, from, from}, {to, to, to}); }

/// Every triangle with vertices of its own, as STL has it.
TriangleMesh exploded(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(mesh.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TriangleMesh without_top(TriangleMesh mesh, double top_mm) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return mesh.vertices[t[0]].z == top_mm && mesh.vertices[t[1]].z == top_mm && mesh.vertices[t[2]].z == top_mm;
  });
  return mesh;
}

Repaired repaired(const TriangleMesh& mesh, const RepairOptions& options = {}) {
  Result<Repaired> result = repair(mesh, options);
  if (!result) throw std::runtime_error(result.error().message);
  EXPECT_EQ(check_solid(result->solid.mesh()).value().defects, MeshDefects{});
  EXPECT_EQ(result->report.volume_after_mm3, result->solid.moments().volume_mm3);
  return *result;
}

std::string reason_against(const TriangleMesh& mesh) {
  const Result<Repaired> result = repair(mesh);
  if (result) return "";
  EXPECT_EQ(result.error().code, ErrorCode::unusable_input);
  return result.error().message;
}

TEST(Repair, a_sound_mesh_is_left_alone) {
  const Repaired result = repaired(cube());
  EXPECT_EQ(result.report.method, RepairMethod::none);
  EXPECT_TRUE(result.report.outer_unchanged);
  EXPECT_TRUE(result.report.steps.empty());
  EXPECT_EQ(result.solid.mesh(), cube());
}

TEST(Repair, triangles_without_shared_vertices_are_only_joined) {
  const Repaired result = repaired(exploded(test::sphere({}, 5, 3)));
  EXPECT_EQ(result.report.method, RepairMethod::none);
  EXPECT_TRUE(result.report.outer_unchanged);
}

TEST(Repair, a_missing_face_is_filled_flat) {
  const Repaired result = repaired(without_top(cube(), 10));
  EXPECT_EQ(result.report.method, RepairMethod::soup);
  EXPECT_FALSE(result.report.outer_unchanged);
  EXPECT_NEAR(result.report.volume_after_mm3, 1000, 1e-9);
  EXPECT_EQ(result.report.max_deviation_mm, 0);
  EXPECT_NEAR(result.report.patched_ratio, 1.0 / 6, 1e-12);
  EXPECT_EQ(result.report.steps.back(), "1 hole filled (largest 14 mm across, together 17 % of the surface).");
}

TEST(Repair, flipped_triangles_are_wound_like_their_neighbours) {
  TriangleMesh mesh = test::sphere({}, 5, 3);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 7) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const Repaired result = repaired(mesh);
  EXPECT_EQ(result.report.method, RepairMethod::soup);
  EXPECT_NEAR(result.report.volume_after_mm3, moments(rounded_to_float(test::sphere({}, 5, 3))).volume_mm3, 1e-9);
}

TEST(Repair, a_solid_inside_out_is_turned) {
  const Repaired result = repaired(reversed(cube()));
  EXPECT_EQ(result.report.steps, std::vector<std::string>{"1 shell was inside out and was turned."});
  EXPECT_EQ(result.report.volume_after_mm3, 1000);
  EXPECT_EQ(result.report.volume_before_mm3, -1000);
}

TEST(Repair, a_coincident_copy_goes) {
  EXPECT_EQ(repaired(joined(cube(), cube())).report.volume_after_mm3, 1000);
  EXPECT_EQ(repaired(joined(cube(), cube())).solid.bodies(), 1U);
}

TEST(Repair, a_void_stays_and_keeps_its_volume) {
  const Repaired sound = repaired(test::with_void(cube(), cube(2, 5)));
  EXPECT_EQ(sound.report.method, RepairMethod::none);
  const Repaired broken = repaired(without_top(test::with_void(cube(), cube(2, 5)), 10));
  for (const Repaired& result : {sound, broken}) {
    EXPECT_NEAR(result.report.volume_after_mm3, 1000 - 27, 1e-9);
    EXPECT_EQ(result.solid.voids(), 1U);
  }
}

TEST(Repair, a_void_of_a_solid_inside_out_is_turned_with_it) {
  const Repaired result = repaired(reversed(test::with_void(cube(), cube(2, 5))));
  EXPECT_NEAR(result.report.volume_after_mm3, 1000 - 27, 1e-9);
  EXPECT_EQ(result.solid.voids(), 1U);
}

TEST(Repair, a_nested_shell_wound_like_the_outer_one_adds_nothing) {
  const Repaired result = repaired(joined(cube(), cube(2, 5)));
  EXPECT_EQ(result.report.volume_after_mm3, 1000);
  EXPECT_EQ(result.solid.voids(), 0U);
  EXPECT_NE(result.report.steps.back().find("reverse its winding"), std::string::npos);
}

TEST(Repair, overlapping_cubes_become_their_union_exactly) {
  const Repaired result = repaired(joined(cube(0, 10), cube(4, 14)));
  EXPECT_EQ(result.report.method, RepairMethod::local);
  EXPECT_NEAR(result.report.volume_after_mm3, 2 * 1000 - 6 * 6 * 6, 1e-6);
  EXPECT_EQ(result.solid.bodies(), 1U);
  EXPECT_NEAR(result.report.max_deviation_mm, 0, 1e-6);
}

TEST(Repair, cubes_that_share_a_face_become_one) {
  const Repaired result = repaired(joined(cube(), test::box({10, 0, 0}, {20, 10, 10})));
  EXPECT_NEAR(result.report.volume_after_mm3, 2000, 1e-6);
  EXPECT_EQ(result.solid.bodies(), 1U);
}

TEST(Repair, a_wall_of_two_sides_between_two_rooms_of_one_surface_goes) {
  TriangleMesh mesh = joined(cube(), test::box({10, 0, 0}, {20, 10, 10}));
  // Both walls at x = 10, cut alike.
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return mesh.vertices[v].x == 10; });
  });
  const auto wall = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{10, 0, 0}, {10, 10, 0}, {10, 10, 10}, {10, 0, 10}});
  for (const Triangle t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}}) {
    mesh.triangles.push_back({wall + t[0], wall + t[1], wall + t[2]});
    mesh.triangles.push_back({wall + t[2], wall + t[1], wall + t[0]});
  }
  const Repaired result = repaired(mesh);
  EXPECT_EQ(result.report.method, RepairMethod::soup);
  EXPECT_NEAR(result.report.volume_after_mm3, 2000, 1e-9);
}

TEST(Repair, a_surface_of_two_sides_everywhere_keeps_one) {
  const Repaired result = repaired(joined(cube(), reversed(cube())));
  EXPECT_EQ(result.report.method, RepairMethod::soup);
  EXPECT_NEAR(result.report.volume_after_mm3, 1000, 1e-9);
}

TEST(Repair, a_sheet_on_a_body_is_not_lost_in_silence) {
  TriangleMesh mesh = cube();
  const auto sheet = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{5, 5, 10}, {5, 5, 30}, {5, 8, 30}});
  mesh.triangles.push_back({sheet, sheet + 1, sheet + 2});
  EXPECT_NE(reason_against(mesh).find("no thickness"), std::string::npos);
  EXPECT_NEAR(repaired(mesh, {.insist = true}).report.volume_after_mm3, 1000, 10);
}

TEST(Repair, cubes_that_share_an_edge_or_a_vertex_keep_their_volume) {
  for (const Vec3 shift : {Vec3{10, 10, 0}, Vec3{10, 10, 10}}) {
    const Repaired result = repaired(joined(cube(), test::box(shift, shift + Vec3{10, 10, 10})));
    EXPECT_EQ(result.report.method, RepairMethod::local);
    EXPECT_NEAR(result.report.volume_after_mm3, 2000, 0.1);
  }
}

TEST(Repair, a_t_junction_is_closed_without_moving_the_surface) {
  TriangleMesh mesh = cube();
  // Cut one edge of one triangle at a vertex that its neighbour does not have.
  const Triangle t = mesh.triangles[0];
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (mesh.vertices[t[0]] + mesh.vertices[t[1]]));
  mesh.triangles[0] = {t[0], middle, t[2]};
  mesh.triangles.push_back({middle, t[1], t[2]});
  const Repaired result = repaired(mesh);
  EXPECT_EQ(result.report.method, RepairMethod::soup);
  EXPECT_NEAR(result.report.volume_after_mm3, 1000, 1e-9);
  EXPECT_NEAR(result.report.max_deviation_mm, 0, 1e-9);
}

TEST(Repair, a_moebius_strip_and_a_lone_triangle_are_refused_with_the_remedy) {
  TriangleMesh strip;
  constexpr std::uint32_t segments = 40;
  for (std::uint32_t i = 0; i < segments; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double turn = 2 * std::numbers::pi * i / segments, out = 10 + side * 3 * std::cos(turn / 2);
      strip.vertices.push_back({out * std::cos(turn), out * std::sin(turn), side * 3 * std::sin(turn / 2)});
    }
  for (std::uint32_t i = 0; i < segments; ++i) {
    const bool last = i + 1 == segments;
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({b, d, c});
  }
  EXPECT_NE(reason_against(strip).find("close it in a modeller"), std::string::npos);
  EXPECT_NE(reason_against({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}), "");
}

TEST(Repair, meshes_without_area_or_volume_are_refused) {
  EXPECT_NE(reason_against({}), "");
  EXPECT_NE(reason_against({{{1, 1, 1}}, {{0, 0, 0}, {0, 0, 0}}}), "");
  EXPECT_NE(reason_against({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {2, 1, 0}}}), "");
  EXPECT_NE(reason_against({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}}}), "");
}

TEST(Repair, when_the_child_may_not_run_the_grid_rebuilds_the_surface) {
  const TriangleMesh mesh = joined(test::sphere({0, 0, 0}, 10, 3), test::sphere({12, 0, 0}, 10, 3));
  const Repaired result = repaired(mesh, {.step_seconds = 0, .remesh_voxels = 80});
  EXPECT_EQ(result.report.method, RepairMethod::remeshed);
  const double cap = std::numbers::pi * 4 * 4 * (30 - 4) / 3;  // of height 4, twice
  const double exact = 2 * (4.0 / 3 * std::numbers::pi * 1000 - cap);
  EXPECT_NEAR(result.report.volume_after_mm3, exact, 0.02 * exact);
  EXPECT_LT(result.report.max_deviation_mm, 1.1 * bounding_box(mesh).diagonal() / 80);
}

TEST(Repair, the_grid_keeps_voids_too) {
  const TriangleMesh mesh = joined(test::with_void(cube(), cube(2, 5)), cube(8, 12));
  const Repaired result = repaired(mesh, {.step_seconds = 0, .remesh_voxels = 80});
  EXPECT_EQ(result.solid.voids(), 1U);
  EXPECT_NEAR(result.report.volume_after_mm3, 1000 - 27 + 64 - 8, 10);
}

TEST(Repair, stops_within_its_step_when_the_caller_says_so) {
  const TriangleMesh mesh = joined(cube(0, 10), cube(4, 14));
  for (int allowed = 0; allowed < 8; ++allowed) {
    int reports = 0;
    const Job job([&](double, std::string_view) { return reports++ < allowed; });
    const Result<Repaired> result = repair(mesh, {}, job);
    EXPECT_TRUE(result || result.error().code == ErrorCode::cancelled);
    EXPECT_TRUE(!result || reports <= allowed);
  }
}

TEST(Repair, every_field_out_of_range_is_named) {
  EXPECT_EQ(find_problem(RepairOptions{}), "");
  EXPECT_NE(find_problem(RepairOptions{.most_patched_ratio = 0}).find("most_patched_ratio"), std::string::npos);
  EXPECT_NE(find_problem(RepairOptions{.step_seconds = -1}).find("step_seconds"), std::string::npos);
  EXPECT_NE(find_problem(RepairOptions{.step_memory_mb = 0}).find("step_memory_mb"), std::string::npos);
  EXPECT_NE(find_problem(RepairOptions{.remesh_voxels = 2}).find("remesh_voxels"), std::string::npos);
}

TEST(SplitPrints, bodies_apart_are_prints_of_their_own) {
  const TriangleMesh first = cube(0, 1), second = cube(2, 3);
  EXPECT_EQ(split_prints(joined(first, second)).value(), (std::vector{first, second}));
  EXPECT_EQ(split_prints(exploded(joined(first, second))).value(), (std::vector{exploded(first), exploded(second)}));
}

TEST(SplitPrints, what_touches_crosses_or_lies_inside_is_one_print) {
  for (const TriangleMesh& other : {cube(1, 2), cube(0.5, 2), cube(0.2, 0.5), reversed(cube(0.2, 0.5))})
    EXPECT_EQ(split_prints(joined(cube(0, 1), other)).value(), std::vector{joined(cube(0, 1), other)});
}

TEST(SplitPrints, open_and_degenerate_crumbs_do_no_harm) {
  TriangleMesh mesh = exploded(without_top(cube(), 10));
  mesh.vertices.push_back({50, 50, 50});
  mesh.triangles.push_back({30, 30, 0});
  EXPECT_GE(split_prints(mesh).value().size(), 1U);
  EXPECT_TRUE(split_prints({}).value().empty());
}

}  // namespace
}  // namespace aplomb
