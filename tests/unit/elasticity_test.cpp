#include "aplomb/printability/elasticity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "support/shapes.h"
#include "support/solids.h"
#include "support/tet_boxes.h"

namespace aplomb {
namespace {

constexpr std::size_t budget_bytes = std::size_t{1} << 30;
constexpr std::array<double, 4> middle{0.25, 0.25, 0.25, 0.25};

/// A box of tetrahedra of many shapes: inner vertices are moved at random.
QuadraticTets uneven_box() {
  TetMesh mesh = test::tet_box({}, {30, 20, 25}, {3, 3, 3});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> by(-1.2, 1.2);
  for (Vec3& v : mesh.vertices)
    if (v.x > 0 && v.x < 30 && v.y > 0 && v.y < 20 && v.z > 0 && v.z < 25) v += {by(random), by(random), by(random)};
  return quadratic_tets(mesh);
}

NodalField field(const QuadraticTets& mesh, const std::function<Vec3(Vec3)>& value) {
  NodalField result;
  for (const Vec3& node : mesh.nodes) result.push_back(value(node));
  return result;
}

std::vector<bool> nodes_where(const QuadraticTets& mesh, const std::function<bool(Vec3)>& is_in) {
  std::vector<bool> result;
  for (const Vec3& node : mesh.nodes) result.push_back(is_in(node));
  return result;
}

double largest(const NodalField& field) {
  double most = 0;
  for (const Vec3& v : field) most = std::max(most, norm(v));
  return most;
}

TEST(Elasticity, reproduces_every_linear_displacement_in_tetrahedra_of_any_shape) {
  const QuadraticTets mesh = uneven_box();
  const Mat3 slope{{{{1e-3, 2e-3, -1e-3}, {5e-4, -2e-3, 3e-4}, {-4e-4, 1e-3, 2e-3}}}};
  const NodalField exact = field(mesh, [&](Vec3 p) { return slope * p + Vec3{0.1, 0.2, 0.3}; });
  const auto is_outside = [](Vec3 p) { return p.x * (30 - p.x) * p.y * (20 - p.y) * p.z * (25 - p.z) < 1e-9; };
  const ElasticLoads loads{nodes_where(mesh, is_outside), exact, {NodalField(mesh.nodes.size())}};
  const auto solved = solve_elasticity(mesh, {}, loads, budget_bytes);
  ASSERT_TRUE(solved);
  for (std::size_t n = 0; n < exact.size(); ++n) EXPECT_LT(norm(solved->front()[n] - exact[n]), 1e-12);
  const Stress first = stress_in(mesh, {}, solved->front(), 0, middle);
  const double trace = 1e-3 - 2e-3 + 2e-3, mu = 2000 / 2.7, lambda = 2000 * 0.35 / (1.35 * 0.3);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Stress s = stress_in(mesh, {}, solved->front(), t, middle);
    EXPECT_NEAR(s.xx, lambda * trace + 2 * mu * 1e-3, 1e-9);
    EXPECT_NEAR(s.xy, mu * 2.5e-3, 1e-9);
    EXPECT_NEAR(s.zz, first.zz, 1e-9);
  }
}

TEST(Elasticity, gives_no_stress_and_no_force_for_a_rigid_motion) {
  const QuadraticTets mesh = uneven_box();
  const Vec3 turn{1e-3, -2e-3, 5e-4};  // small: a linear theory
  const NodalField moved = field(mesh, [&](Vec3 p) { return Vec3{3, -1, 2} + cross(turn, p); });
  EXPECT_LT(largest(elastic_forces_n(mesh, {}, moved)), 1e-9);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    EXPECT_LT(largest_principal_mpa(stress_in(mesh, {}, moved, t, middle)), 1e-10);
}

TEST(Elasticity, finds_the_principal_stresses_of_a_tensor_turned_anyhow) {
  for (const Vec3& values : {Vec3{3, 1, -7}, Vec3{5, 5, 5}, Vec3{2, 2, -1}, Vec3{0, 0, 4}, Vec3{}}) {
    const Mat3 turn = test::rotation(normalized(Vec3{1, 2, 3}), 0.8).linear;
    const Mat3 diagonal{{{{values.x, 0, 0}, {0, values.y, 0}, {0, 0, values.z}}}};
    const Mat3 s = turn * diagonal * transposed(turn);
    const Stress stress{s.rows[0].x, s.rows[1].y, s.rows[2].z, s.rows[0].y, s.rows[1].z, s.rows[2].x};
    const double exact = std::max({std::abs(values.x), std::abs(values.y), std::abs(values.z)});
    EXPECT_NEAR(largest_principal_mpa(stress), exact, 1e-6);
  }
}

/// What of a beam of 10 x 8 x 100 mm, held at z = 0 and pushed at its end along x.
struct Cantilever {
  double tip_mm = 0, bending_mpa = 0;  ///< the stress at x = 10, z = 30
};
Cantilever bent(test::CellCount cells) {
  const ElasticMaterial material{2000, 0};  // nothing contracts across, so that the clamp is the book's
  const QuadraticTets mesh = quadratic_tets(test::tet_box({}, {10, 8, 100}, cells));
  NodalField push(mesh.nodes.size());
  const std::vector<bool> top = nodes_where(mesh, [](Vec3 p) { return p.z > 100 - 1e-9; });
  const auto count = static_cast<double>(std::count(top.begin(), top.end(), true));
  for (std::size_t n = 0; n < push.size(); ++n)
    if (top[n]) push[n] = {10 / count, 0, 0};
  const ElasticLoads loads{nodes_where(mesh, [](Vec3 p) { return p.z < 1e-9; }), {}, {push}};
  const NodalField moved = solve_elasticity(mesh, material, loads, budget_bytes).value().front();
  Cantilever result;
  double found = 0;
  for (std::size_t n = 0; n < push.size(); ++n)
    if (top[n]) result.tip_mm += moved[n].x / count;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t corner = 0; corner < 4; ++corner)
      if (const Vec3 p = mesh.nodes[mesh.tets[t][corner]]; p.x > 9.99 && std::abs(p.z - 30) < 1e-6) {
        std::array<double, 4> place{};
        place[corner] = 1;
        result.bending_mpa -= stress_in(mesh, material, moved, t, place).zz;
        ++found;
      }
  result.bending_mpa /= found;
  return result;
}

TEST(Elasticity, bends_a_cantilever_as_timoshenko_has_it_and_nearer_with_smaller_tetrahedra) {
  const double inertia = 8 * 1000 / 12.0, young = 2000, mu = young / 2, shear_share = 10.0 / 12;
  const double tip = 10 * 1e6 / (3 * young * inertia) + 10 * 100 / (shear_share * mu * 80);
  const double bending = 10 * 70 * 5 / inertia;
  const Cantilever coarse = bent({1, 1, 10}), fine = bent({2, 2, 20}), finest = bent({4, 3, 40});
  EXPECT_NEAR(coarse.tip_mm, tip, 0.03 * tip);
  EXPECT_NEAR(fine.tip_mm, tip, 0.01 * tip);
  EXPECT_NEAR(finest.tip_mm, tip, 0.003 * tip);
  EXPECT_NEAR(fine.bending_mpa, bending, 0.02 * bending);
  EXPECT_NEAR(finest.bending_mpa, bending, 0.01 * bending);
  EXPECT_LT(coarse.tip_mm, fine.tip_mm);  // a bound from below (Ritz)
  EXPECT_LT(fine.tip_mm, finest.tip_mm);
  EXPECT_LT(finest.tip_mm - fine.tip_mm, fine.tip_mm - coarse.tip_mm);
}

TEST(Elasticity, stresses_under_given_forces_do_not_depend_on_youngs_modulus) {
  const QuadraticTets mesh = uneven_box();
  NodalField push(mesh.nodes.size());
  for (std::size_t n = 0; n < push.size(); ++n)
    if (mesh.nodes[n].z > 24.9) push[n] = {1, 2, -3};
  const ElasticLoads loads{nodes_where(mesh, [](Vec3 p) { return p.z < 1e-9; }), {}, {push}};
  const auto stress = [&](double young) {
    const ElasticMaterial material{young, 0.3};
    const auto moved = solve_elasticity(mesh, material, loads, budget_bytes);
    return largest_principal_mpa(stress_in(mesh, material, moved->front(), 40, middle));
  };
  EXPECT_NEAR(stress(5), stress(70000), 1e-9);
}

TEST(Elasticity, refuses_what_is_over_the_budget_and_stops_when_told) {
  const QuadraticTets mesh = quadratic_tets(test::tet_box({}, {10, 10, 10}, {4, 4, 4}));
  const ElasticLoads loads{nodes_where(mesh, [](Vec3 p) { return p.z < 1e-9; }), {}, {NodalField(mesh.nodes.size())}};
  const auto refused = solve_elasticity(mesh, {}, loads, 100'000);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::over_budget);
  EXPECT_NE(refused.error().message.find("unknowns would take"), std::string::npos);
  for (int report : {1, 2, 3}) {
    test::CancelAt cancel(report);
    const auto stopped = solve_elasticity(mesh, {}, loads, budget_bytes, cancel.job());
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace aplomb
