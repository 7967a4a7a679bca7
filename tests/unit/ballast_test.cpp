#include "aplomb/fdm/ballast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "aplomb/mesh/solid_mesh.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

PrintProfile sparse_profile() {
  PrintProfile p;
  p.layer_mm = p.first_layer_mm = 0.25;
  p.external_width_mm = p.perimeter_width_mm = p.infill_width_mm = p.solid_width_mm = 0.4;
  p.perimeters = 2;
  p.top_layers = p.bottom_layers = 4;
  p.infill_ratio = 0.15;
  p.infill_overlap_mm = 0;
  p.ensures_shell_thickness = true;
  return p;
}

LayeredPrint layered(const TriangleMesh& mesh, const PrintProfile& profile = sparse_profile()) {
  const auto solid = check_solid(mesh);
  if (!solid || !solid->solid) throw std::runtime_error("no solid");
  auto print = LayeredPrint::make(printed_solid(*solid->solid), profile);
  if (!print) throw std::runtime_error(print.error().message);
  return std::move(*print);
}

/// That the centre of mass lies within |x| <= half_mm, and as low as can be: t is the tangent of the tip angle.
BalanceProblem between(double half_mm) {
  const AffineForm height{0, {0, 0, 1}};
  return {{{{half_mm, {1, 0, 0}}, height}, {{half_mm, {-1, 0, 0}}, height}}};
}

PredictedPrint filled(const LayeredPrint& print, const std::optional<DenseInfill>& denser = {}) {
  const auto made = print.fill(denser);
  if (!made) throw std::runtime_error(made.error().message);
  return *made;
}

TEST(Ballast, DenseInfillEverywhereIsASolidPrint) {
  const TriangleMesh cube = test::box({0, 0, 0}, {30, 20, 10});
  PrintProfile solid = sparse_profile();
  solid.infill_ratio = 1;
  const Moments dense = filled(layered(cube), DenseInfill{{1, {}}, 1}).all(), all = filled(layered(cube, solid)).all();
  EXPECT_NEAR(dense.volume_mm3, all.volume_mm3, 1e-6 * all.volume_mm3);
  EXPECT_NEAR(norm(dense.centroid_mm() - all.centroid_mm()), 0, 1e-6);
}

TEST(Ballast, DenseInfillNowhereChangesNothing) {
  const LayeredPrint print = layered(test::box({0, 0, 0}, {30, 20, 10}));
  const DenseInfill nowhere{{-1, {}}, 1};
  EXPECT_EQ(filled(print, nowhere).all().volume_mm3, filled(print).all().volume_mm3);
  EXPECT_EQ(print.added_by(nowhere).volume_mm3, 0);
}

/// The core of a box is a box: of 15 % on one side, solid on the other.
TEST(Ballast, ABoxHalfDenseHasTheMassOfClosedForms) {
  PrintProfile p = sparse_profile();
  p.thick_bridges = false;
  const LayeredPrint print = layered(test::box({0, 0, 0}, {30, 20, 10}), p);
  const DenseInfill right{{-18, {1, 0, 0}}, 1};
  const double gap = p.bead_gap_mm(), depth = 0.4 - gap / 2 + 0.4 - gap, core = 8 * (20 - 2 * depth);
  const Moments sparse = filled(print).all(), dense = filled(print, right).all(), added = print.added_by(right);
  const double links =
      0.25 * std::pow(0.85, 1.5) * 2 * (50 - 4 * depth) * (0.4 - gap) / ((30 - 2 * depth) * (20 - 2 * depth));
  EXPECT_NEAR(added.volume_mm3, (0.85 - links) * core * (30 - depth - 18), 0.5);
  EXPECT_NEAR(added.centroid_mm().x, (18 + 30 - depth) / 2, 0.01);
  EXPECT_NEAR(dense.volume_mm3 - sparse.volume_mm3, added.volume_mm3,
              0.01 * added.volume_mm3);  // the sparse rim differs
}

TEST(Ballast, ReachesTheAngleWithTheLeastMassAndNotWithLess) {
  const LayeredPrint print = layered(test::leaning_prism(20, 20, 40, 16));
  const BalanceProblem problem = between(10);
  const double before_t = largest_t(problem, filled(print).all()), required_t = before_t + 0.05;
  const auto made = choose_ballast(print, problem, {CarveAim::least, required_t, 1});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->reaches);
  EXPECT_GE(made->t, required_t);
  EXPECT_LT(made->t, required_t + 2e-3);
  EXPECT_GT(made->bound_t, required_t);
  EXPECT_NEAR(largest_t(problem, filled(print, made->infill).all()), made->t, 1e-12);
  DenseInfill smaller = made->infill;
  smaller.dense.constant -= 0.3 * norm(smaller.dense.gradient);
  EXPECT_LT(largest_t(problem, filled(print, smaller).all()), required_t);
}

TEST(Ballast, NoHalfSpaceExceedsTheBound) {
  const LayeredPrint print = layered(test::leaning_prism(20, 20, 40, 16));
  const BalanceProblem problem = between(10);
  const auto made = choose_ballast(print, problem, {CarveAim::stable, 0, 1});
  ASSERT_TRUE(made);
  const Moments sparse = filled(print).all();
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  double best = -1;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 direction{normal(random), normal(random), normal(random)},
        at{10 * normal(random), 0, 20 + 10 * normal(random)};
    const double t = largest_t(problem, sparse + print.added_by({{-dot(direction, at), direction}, 1}));
    best = std::max(best, t);
    EXPECT_LE(t, made->bound_t + 1e-6);
  }
  EXPECT_GT(best, made->bound_t - 0.05);  // the trials come near
  EXPECT_NEAR(made->t, made->bound_t, 5e-3);
}

TEST(Ballast, WhatCannotBeReachedGivesTheMostStable) {
  const LayeredPrint print = layered(test::leaning_prism(20, 20, 40, 16));
  const auto made = choose_ballast(print, between(10), {CarveAim::least, 5, 1});
  ASSERT_TRUE(made);
  EXPECT_FALSE(made->reaches);
  EXPECT_LT(made->bound_t, 5);
  EXPECT_NEAR(made->t, made->bound_t, 5e-3);
}

TEST(Ballast, ADenserSideGivesMore) {
  const LayeredPrint print = layered(test::leaning_prism(20, 20, 40, 16));
  double last = largest_t(between(10), filled(print).all());
  for (const double ratio : {0.3, 0.6, 1.0}) {
    const auto made = choose_ballast(print, between(10), {CarveAim::stable, 0, ratio});
    ASSERT_TRUE(made);
    EXPECT_GT(made->t, last) << ratio;
    last = made->t;
  }
}

TEST(Ballast, EndsWhenItIsCancelled) {
  const Job job([](double fraction, std::string_view) { return fraction < 0.2; });
  const auto made =
      choose_ballast(layered(test::leaning_prism(20, 20, 40, 16)), between(10), {CarveAim::least, 0.1, 1}, job);
  EXPECT_EQ(made.error().code, ErrorCode::cancelled);
}

TEST(PartOfBox, IsClosedAndHasTheVolumeOfClosedForms) {
  const Box3 box{{-1, -2, 0}, {3, 2, 5}};
  EXPECT_NEAR(moments(part_of_box(box, {1, {}})).volume_mm3, 80, 1e-12);
  EXPECT_TRUE(part_of_box(box, {-1, {}}).triangles.empty());
  const Moments right = moments(part_of_box(box, {-1, {1, 0, 0}}));
  EXPECT_NEAR(right.volume_mm3, 40, 1e-12);
  EXPECT_NEAR(norm(right.centroid_mm() - Vec3{2, 0, 2.5}), 0, 1e-12);
  const Moments corner = moments(part_of_box(box, {-3 - 2 - 5 + 1.5, {1, 1, 1}}));  // a corner of edges 1.5
  EXPECT_NEAR(corner.volume_mm3, std::pow(1.5, 3) / 6, 1e-12);
}

TEST(PartOfBox, OnEitherSideOfAnyPlaneIsASolidAndBothMakeTheBox) {
  const Box3 box{{-1, -2, 0}, {3, 2, 5}};
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 n{normal(random), normal(random), normal(random)};
    const AffineForm form{-dot(n, Vec3{1, 0, 2.5} + Vec3{normal(random), normal(random), normal(random)}), n};
    double volume = 0;
    for (const AffineForm& side : {form, -1 * form}) {
      const TriangleMesh part = part_of_box(box, side);
      if (part.triangles.empty()) continue;
      const auto solid = check_solid(part);
      ASSERT_TRUE(solid && solid->solid) << trial;
      volume += moments(part).volume_mm3;
    }
    EXPECT_NEAR(volume, 80, 1e-9);
  }
}

}  // namespace
}  // namespace aplomb
