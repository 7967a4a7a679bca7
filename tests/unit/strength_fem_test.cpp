#include "aplomb/printability/strength_fem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "aplomb/adapters/tetgen/tetrahedralize.h"
#include "aplomb/printability/elasticity.h"
#include "aplomb/printability/judge.h"
#include "aplomb/printability/strength_ankle.h"
#include "support/prints.h"

namespace aplomb {
namespace {

constexpr double push_n = 10, newton_per_g = 9.80665e-3, weightless = 1e-9;

FemStrength strength_of(const TriangleMesh& mesh, double density = weightless) {
  const test::Print print = test::print_of(mesh);
  return measure_strength_fem(print.printed, print.slices, Rules(Process::fdm), {.density_g_per_cm3 = density}).value();
}
double measured(const TriangleMesh& mesh, double density = weightless) {
  const FemStrength strength = strength_of(mesh, density);
  EXPECT_FALSE(strength.places.empty());
  return strength.places.empty() ? 0 : strength.places.front().measured;
}

/// What 1 mm3 of a square post, whose middle may be empty, exceeds by beam theory, from half a width above the plate.
double square_post_mpa(double width, double height, double empty_width = 0) {
  constexpr int across = 60, along = 240;
  const double inertia = (std::pow(width, 4) - std::pow(empty_width, 4)) / 12;
  const double from = width / std::sqrt(std::numbers::pi), step = width / across, rise = 24.0 / along;
  double worst = 0;
  for (const double azimuth : {0.0, 0.2, 0.4, 0.6, std::numbers::pi / 4}) {
    std::vector<double> stresses;
    for (int i = 0; i < across; ++i)
      for (int j = 0; j < across; ++j) {
        const double x = (i + 0.5) * step - width / 2, y = (j + 0.5) * step - width / 2;
        if (std::max(std::abs(x), std::abs(y)) < empty_width / 2) continue;
        const double q = std::abs(x * std::cos(azimuth) + y * std::sin(azimuth));
        for (int k = 0; k < along; ++k) stresses.push_back(push_n * (height - from - (k + 0.5) * rise) * q / inertia);
      }
    const auto rank = std::ptrdiff_t(1 / (step * step * rise));
    std::ranges::nth_element(stresses, stresses.begin() + rank, std::greater{});
    worst = std::max(worst, stresses[std::size_t(rank)]);
  }
  return worst;
}
TriangleMesh square_post(double width, double height) {
  return test::box({-width / 2, -width / 2, 0}, {width / 2, width / 2, height});
}

TEST(StrengthFem, a_post_pushed_at_its_top_bends_as_beam_theory_has_it_whichever_way_it_is_turned) {
  const double exact = square_post_mpa(8, 80);
  for (const double turn : {0.0, 0.5, 1.2})
    EXPECT_NEAR(measured(transformed(square_post(8, 80), test::rotation({0, 0, 1}, turn))), exact, 0.02 * exact);
}

TEST(StrengthFem, two_percent_around_the_limit_shows) {
  const double width = 6;
  double least = 30, most = 120;  // the height at which 16.5 MPa are reached
  for (int step = 0; step < 12; ++step)
    (square_post_mpa(width, (least + most) / 2) < 16.5 ? least : most) = (least + most) / 2;
  const double from = width / std::sqrt(std::numbers::pi);
  for (const double factor : {0.98, 1.02})
    EXPECT_EQ(measured(square_post(width, from + factor * (least - from))) > 16.5, factor > 1);
}

TEST(StrengthFem, a_hollow_post_bends_by_the_section_of_its_walls) {
  const TriangleMesh hollow = test::with_void(square_post(10, 80), test::box({-3, -3, 3}, {3, 3, 77}));
  const double exact = square_post_mpa(10, 80, 6), solid = square_post_mpa(10, 80);
  EXPECT_NEAR(measured(hollow), exact, 0.03 * exact);
  EXPECT_GT(exact, 1.1 * solid);
}

TEST(StrengthFem, a_column_bears_what_is_above) {
  const double density = 1e6, half_width = 10 / std::sqrt(std::numbers::pi);
  const double exact = density * 1e-3 * newton_per_g * (60 - half_width);
  // The clamp keeps the foot from spreading: half a width above it the middle still bears 5 % more than the mean.
  EXPECT_NEAR(measured(square_post(10, 60), density), 1.03 * exact, 0.03 * exact);
}

TEST(StrengthFem, agrees_with_the_sections_on_a_long_thin_ankle) {
  const TriangleMesh figure = test::lathe({{0, 0}, {5, 0}, {4, 20}, {4, 50}, {6, 56}, {15, 70}, {15, 90}, {0, 90}}, 64);
  const test::Print print = test::print_of(figure);
  const Place ankle = measure_strength_ankle(print.printed, print.slices, Rules(Process::fdm), 1.24).value().front();
  const FemStrength fem = strength_of(figure, 1.24);
  EXPECT_NEAR(fem.places.front().measured, ankle.measured, 0.1 * ankle.measured);
  EXPECT_NEAR(fem.places.front().at_mm.z, ankle.at_mm.z, 4);
  EXPECT_NEAR(fem.places.front().at_mm.x, 0, 2);
}

TEST(StrengthFem, the_picture_is_of_the_solids_surface_and_shows_the_stress_on_it) {
  const FemStrength fem = strength_of(square_post(8, 80));
  const StressField& field = fem.field.value();
  ASSERT_EQ(field.stress_mpa.size(), field.surface.vertices.size());
  EXPECT_NEAR(moments(field.surface).volume_mm3, 8 * 8 * 80, 1e-6);
  double middle = 0, count = 0;
  for (std::size_t v = 0; v < field.stress_mpa.size(); ++v)
    if (const Vec3 p = field.surface.vertices[v];
        std::abs(std::abs(p.x) - 4) + std::abs(std::abs(p.y) - 4) < 1e-6 && p.z > 20 && p.z < 60) {
      middle += field.stress_mpa[v] / (push_n * (80 - p.z) * 4 * std::sqrt(2.0) / (4096 / 12.0));
      ++count;
    }
  EXPECT_NEAR(middle / count, 1, 0.03);
}

TEST(StrengthFem, what_touches_the_plate_in_a_point_is_not_judged_and_what_is_only_wide_has_nothing_to_judge) {
  const TriangleMesh spike = test::frustum({}, 0, 5, 60, 24);
  EXPECT_NE(strength_of(spike).why_not.find("less than three points"), std::string::npos);
  const FemStrength plate = strength_of(test::box({}, {60, 60, 2}));
  EXPECT_TRUE(plate.places.empty() && plate.why_not.empty());
}

TEST(StrengthFem, too_many_tetrahedra_are_refused_with_their_number_and_cancel_is_heard) {
  const test::Print print = test::print_of(square_post(8, 80));
  FemOptions options;
  options.tets.most = 50;
  const auto refused = measure_strength_fem(print.printed, print.slices, Rules(Process::fdm), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::over_budget);
  EXPECT_NE(refused.error().message.find("at most 50"), std::string::npos);
  test::CancelAt cancel(6);
  const auto stopped = measure_strength_fem(print.printed, print.slices, Rules(Process::fdm), {}, cancel.job());
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST(StrengthFem, is_judged_only_where_it_is_asked_for) {
  const auto results = [](const TriangleMesh& mesh, bool fem) {
    JudgeOptions options;
    options.fem = fem;
    const Judgement judgement = judge(mesh, options).value();
    EXPECT_EQ(judgement.stress.has_value(), fem && mesh.triangles.size() == 12);
    return std::ranges::count(judgement.checks, std::string("strength.fem"), &CheckResult::id);
  };
  TriangleMesh post = square_post(12, 60);
  EXPECT_EQ(results(post, false), 0);
  EXPECT_EQ(results(post, true), 1);
  post.triangles.pop_back();
  EXPECT_EQ(results(post, false), 0);
  EXPECT_EQ(results(post, true), 1);
}

/// A plate with a round hole through its middle, pulled along x.
constexpr double plate_x = 120, plate_y = 40, thick = 2, hole = 5;
TriangleMesh holed_plate() {
  constexpr int segments = 96;
  std::vector<Vec2> inner, outer;
  for (int n = 0; n < segments; ++n) {
    const double angle = 2 * std::numbers::pi * (n + 0.5) / segments, x = std::cos(angle), y = std::sin(angle);
    const double reach = std::min(plate_x / 2 / std::abs(x), plate_y / 2 / std::abs(y));
    inner.push_back({hole * x, hole * y});
    outer.push_back({reach * x, reach * y});
  }
  TriangleMesh mesh;
  for (const double z : {0.0, thick})
    for (const auto* loop : {&inner, &outer})
      for (const Vec2 p : *loop) mesh.vertices.push_back({p.x, p.y, z});
  const auto quad = [&](unsigned a, unsigned b, unsigned c, unsigned d) {
    mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
  };
  constexpr unsigned o = segments, up = 2 * segments;
  for (unsigned n = 0, m = 1; n < segments; ++n, m = (n + 1) % segments) {
    quad(n, m, o + m, o + n);                      // below
    quad(up + n, up + o + n, up + o + m, up + m);  // above
    quad(n, up + n, up + m, m);                    // in the hole
    quad(o + n, o + m, up + o + m, up + o + n);    // outside
  }
  return mesh;
}

TEST(Elasticity, a_hole_in_a_plate_pulled_concentrates_the_stress_as_howland_has_it) {
  const auto tets = adapters::tetrahedralize(holed_plate(), {}, {10, 1.6}, {});
  ASSERT_TRUE(tets) << tets.error().message;
  const QuadraticTets mesh = quadratic_tets(*tets);
  ElasticLoads loads;
  loads.forces_n = {NodalField(mesh.nodes.size())};
  double pulled = 0;
  for (const Vec3& node : mesh.nodes) {
    loads.held.push_back(node.x < -plate_x / 2 + 1e-6);
    pulled += node.x > plate_x / 2 - 1e-6;
  }
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n].x > plate_x / 2 - 1e-6) loads.forces_n[0][n].x = plate_y * thick / pulled;  // 1 MPa
  const ElasticMaterial material{2000, 0.3};
  const NodalField moved = solve_elasticity(mesh, material, loads, std::size_t{2} << 30).value().front();
  double sum = 0, count = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const Vec3 p = mesh.nodes[mesh.tets[t][corner]];
      if (std::hypot(p.x, p.y) > hole + 1e-3 || std::abs(p.x) > 0.2) continue;
      std::array<double, 4> place{};
      place[corner] = 1;
      sum += stress_in(mesh, material, moved, t, place).xx;
      ++count;
    }
  const double ratio = 2 * hole / plate_y, howland = (2 + std::pow(1 - ratio, 3)) / (1 - ratio);  // Heywood's fit
  EXPECT_NEAR(sum / count, howland, 0.04 * howland);
}

}  // namespace
}  // namespace aplomb
