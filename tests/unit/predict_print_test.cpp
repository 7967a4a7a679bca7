#include "aplomb/fdm/predict_print.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shapes.h"

namespace aplomb {
namespace {

/// Layers of 0.25 mm, so that 10 mm are 40 of them; beads of 0.4 mm.
PrintProfile profile_of(double infill_ratio) {
  PrintProfile p;
  p.layer_mm = p.first_layer_mm = 0.25;
  p.external_width_mm = p.perimeter_width_mm = p.infill_width_mm = p.solid_width_mm = 0.4;
  p.perimeters = 2;
  p.top_layers = p.bottom_layers = 4;
  p.infill_ratio = infill_ratio;
  p.infill_overlap_mm = 0;
  p.solid_below_mm2 = 0;
  p.ensures_shell_thickness = true;
  p.thick_bridges = false;
  return p;
}

PredictedPrint predicted(const TriangleMesh& mesh, const PrintProfile& profile) {
  const auto solid = check_solid(mesh);
  if (!solid || !solid->solid) throw std::runtime_error("no solid");
  const auto print = predict_print(printed_solid(*solid->solid), profile);
  if (!print) throw std::runtime_error(print.error().message);
  return *print;
}

const double gap_mm = (1 - std::numbers::pi / 4) * 0.25;          // between beads with round sides
const double depth_mm = 0.2 + (0.4 - gap_mm) / 2 + 0.4 - gap_mm;  // of two perimeters

TEST(PredictPrint, ABoxHasTheWallsSkinsAndInfillOfClosedForms) {
  const PredictedPrint print = predicted(test::box({0, 0, 0}, {30, 20, 10}), profile_of(0.2));
  const double outer_mm2 = (30 - gap_mm) * (20 - gap_mm), core_mm2 = (30 - 2 * depth_mm) * (20 - 2 * depth_mm);
  EXPECT_NEAR(print.walls.volume_mm3, 10 * (outer_mm2 - core_mm2), 0.5);
  EXPECT_NEAR(print.solid_infill.volume_mm3, 2 * core_mm2, 0.5);
  const double rim_mm = 2 * (50 - 4 * depth_mm), links_mm2 = 0.25 * std::pow(0.8, 1.5) * rim_mm * (0.4 - gap_mm);
  EXPECT_NEAR(print.sparse_infill.volume_mm3, 8 * (0.2 * core_mm2 + links_mm2), 0.5);
  EXPECT_NEAR(norm(print.all().centroid_mm() - Vec3{15, 10, 5}), 0, 1e-3);
}

TEST(PredictPrint, AtFullInfillItIsTheSolidLessTheOutermostBeadsRoundSide) {
  const PredictedPrint print = predicted(test::leaning_prism(20, 20, 30, 10), profile_of(1));
  EXPECT_EQ(print.sparse_infill.volume_mm3, 0);
  EXPECT_NEAR(print.all().volume_mm3, 30 * std::pow(20 - gap_mm, 2), 8);
  EXPECT_NEAR(norm(print.all().centroid_mm() - moments(test::leaning_prism(20, 20, 30, 10)).centroid_mm()), 0, 0.02);
}

TEST(PredictPrint, MoreInfillWeighsMore) {
  const TriangleMesh body = test::leaning_prism(20, 20, 30, 10);
  double last = 0;
  for (const double ratio : {0.0, 0.1, 0.2, 0.5, 0.8, 1.0}) {
    const double volume = predicted(body, profile_of(ratio)).all().volume_mm3;
    EXPECT_GT(volume, last) << ratio;
    last = volume;
  }
}

TEST(PredictPrint, TranslationMovesIt) {
  const TriangleMesh body = test::leaning_prism(20, 20, 30, 10);
  TriangleMesh moved = body;
  for (Vec3& v : moved.vertices) v += {100, -50, 7};
  const Moments a = predicted(body, profile_of(0.15)).all(), b = predicted(moved, profile_of(0.15)).all();
  EXPECT_NEAR(a.volume_mm3, b.volume_mm3, 1e-3 * a.volume_mm3);
  EXPECT_NEAR(norm(b.centroid_mm() - a.centroid_mm() - Vec3{100, -50, 7}), 0, 1e-2);
}

/// Over a slope of 45 degrees each layer is one layer's height shorter: with shells that keep their thickness the skin
/// under the slope is three layers' worth wide, three fewer than without walls.
TEST(PredictPrint, SlopedSkinsAreAsWideAsTheyAreThick) {
  PrintProfile p = profile_of(0.1);
  p.bottom_layers = 0;
  const TriangleMesh upright = test::box({0, 0, 0}, {30, 30, 20}), leaning = test::leaning_prism(30, 30, 20, 20);
  const double core_mm = 30 - 2 * depth_mm;
  const double extra_mm3 =
      predicted(leaning, p).solid_infill.volume_mm3 - predicted(upright, p).solid_infill.volume_mm3;
  EXPECT_NEAR(extra_mm3, (20 - 4 * 0.25) * core_mm * 3 * 0.25, 0.03 * extra_mm3);
}

TEST(PredictPrint, ThinCoresAreFilled) {
  PrintProfile p = profile_of(0.1);
  const TriangleMesh post = test::box({0, 0, 0}, {9, 9, 20});
  EXPECT_GT(predicted(post, p).sparse_infill.volume_mm3, 0);
  p.solid_below_mm2 = 70;
  EXPECT_EQ(predicted(post, p).sparse_infill.volume_mm3, 0);
  EXPECT_GT(predicted(test::box({0, 0, 0}, {12, 12, 20}), p).sparse_infill.volume_mm3, 0);
}

TEST(PredictPrint, ASmallVoidInSparseInfillAddsMassAndInASolidPrintItTakesSome) {
  const TriangleMesh full = test::box({0, 0, 0}, {40, 40, 40});
  const TriangleMesh hollow = test::with_void(full, test::box({15, 15, 15}, {25, 25, 25}));
  EXPECT_GT(predicted(hollow, profile_of(0.15)).all().volume_mm3, predicted(full, profile_of(0.15)).all().volume_mm3);
  EXPECT_LT(predicted(hollow, profile_of(1)).all().volume_mm3, predicted(full, profile_of(1)).all().volume_mm3);
}

TEST(PredictPrint, ABodyIsMadeOfTheKindsThatAreThere) {
  const PredictedPrint print = predicted(test::box({0, 0, 0}, {30, 20, 10}), profile_of(1));
  const auto body = print.body(1.27);
  ASSERT_EQ(body.size(), 2u);
  EXPECT_NEAR(mass_of(body).mass_g, 1.27e-3 * print.all().volume_mm3, 1e-9);
}

TEST(PredictPrint, EndsWhenItIsCancelled) {
  const auto solid = check_solid(test::box({0, 0, 0}, {30, 20, 10}));
  const Job job([](double fraction, std::string_view) { return fraction < 0.5; });
  EXPECT_EQ(predict_print(printed_solid(*solid->solid), profile_of(0.2), job).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace aplomb
