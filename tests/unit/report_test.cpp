#include "aplomb/report/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "aplomb/report/json.h"
#include "aplomb/report/text.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

constexpr double degree = std::numbers::pi / 180;
using Json = nlohmann::json;

Standing standing_of(const TriangleMesh& mesh) {
  const Region body{moments(mesh), 1.24};
  return measure_standing(mesh, {&body, 1}, {}).value();
}

Report check_of(const TriangleMesh& mesh) {
  Report report;
  report.required_tip_rad = 10 * degree;
  report.before = standing_of(mesh);
  report.outcome =
      report.before.stability.tip_rad >= report.required_tip_rad ? Outcome::already_stands : Outcome::falls;
  return report;
}

Report full_report() {
  Report report = check_of(test::leaning_prism(10, 12, 40, 12));
  report.outcome = Outcome::stands;
  report.after = standing_of(test::with_void(test::leaning_prism(10, 12, 40, 12), test::box({5, -4, 25}, {9, 4, 36})));
  report.carving = CarvingFigures{"least", 352, 12 * degree, 0.5 * degree, 17};
  report.wall = WallFigures{2, 2.0125};
  report.mesh = MeshFigures{true, true, 0, 1, 24};
  report.repair = {"closed 2 holes"};
  report.stage_seconds = {{"read", 0.25}, {"carve", 1.5}};
  report.peak_memory_mb = 123;
  report.options = {{"up", std::string("z")}, {"tip_deg", 10.0}, {"robust", false}};
  report.version = "0.1.0";
  return report;
}

TEST(ReportText, TellsABestEffortFromWhatWasAskedForByItsDigits) {
  Report report = full_report();
  report.outcome = Outcome::best_effort;
  report.after->stability.tip_rad = 9.986 * degree;
  EXPECT_TRUE(verdict(report).starts_with("Cannot reach 10.0 degrees: 9.986 degrees at best")) << verdict(report);
  report.after->stability.tip_rad = 7.86 * degree;
  EXPECT_TRUE(verdict(report).starts_with("Cannot reach 10.0 degrees: 7.9 degrees at best")) << verdict(report);
}

TEST(ReportJson, HasEveryKeyThatIsPromised) {
  const Json json = Json::parse(to_json(full_report()));
  for (const char* key : {"outcome", "before", "after", "carving", "wall_mm", "mesh", "repair", "seconds",
                          "peak_memory_mb", "options", "version"})
    EXPECT_TRUE(json.contains(key)) << key;
  for (const char* when : {"before", "after"})
    for (const char* key : {"mass_g", "volume_mm3", "com_mm", "margin_mm", "tip_deg", "robust_tip_deg", "weak_edge",
                            "support_polygon_mm"})
      EXPECT_TRUE(json[when].contains(key)) << when << "." << key;
  for (const char* key : {"aim", "void_mm3", "bound_deg", "gap_deg", "planes"})
    EXPECT_TRUE(json["carving"].contains(key)) << key;
  for (const char* key : {"required", "measured"}) EXPECT_TRUE(json["wall_mm"].contains(key)) << key;
  for (const char* key : {"outer_unchanged", "closed", "self_intersections", "voids", "triangles"})
    EXPECT_TRUE(json["mesh"].contains(key)) << key;
}

TEST(ReportJson, HoldsTheFiguresInTheUnitsOfTheirNames) {
  const Report report = full_report();
  const Json json = Json::parse(to_json(report));
  EXPECT_DOUBLE_EQ(json["before"]["tip_deg"].get<double>() * degree, report.before.stability.tip_rad);
  EXPECT_EQ(json["before"]["mass_g"].get<double>(), report.before.stability.mass_g);
  EXPECT_EQ(json["before"]["support_polygon_mm"].size(), 4u);
  EXPECT_DOUBLE_EQ(json["carving"]["bound_deg"].get<double>(), 12);
  EXPECT_EQ(json["outcome"], "stands");
  EXPECT_EQ(json["seconds"]["carve"], 1.5);
  EXPECT_EQ(json["options"]["robust"], false);
  EXPECT_EQ(json["options"]["up"], "z");
}

TEST(ReportJson, LeavesOutWhatTheRunHadNoUseFor) {
  const Json json = Json::parse(to_json(check_of(test::box({0, 0, 0}, {20, 20, 20}))));
  for (const char* key : {"after", "carving", "wall_mm", "mesh"}) EXPECT_FALSE(json.contains(key)) << key;
  EXPECT_FALSE(json["before"].contains("pedestal"));
  EXPECT_EQ(json["outcome"], "already_stands");
}

TEST(ReportText, SaysFirstWhetherItStands) {
  EXPECT_EQ(verdict(check_of(test::box({0, 0, 0}, {20, 30, 20}))),
            "Stands: 45.0 degrees (weakest towards +x; 10.0 asked)");
  EXPECT_EQ(verdict(check_of(test::leaning_prism(10, 30, 40, 20))),
            "Falls: tips over to the +x side, -13.9 degrees (10.0 asked)");
  EXPECT_EQ(verdict(check_of(test::box({0, 0, 0}, {4, 30, 60}))),
            "Stands, but barely: 3.8 degrees (weakest towards +x; 10.0 asked)");
  EXPECT_TRUE(to_text(full_report()).starts_with("Stands now: "));
}

TEST(ReportText, NeverRoundsAFallToAStandingZero) {
  const double critical_lean = 10 / (1 - 2 * 0.1 / 40);
  const std::string text = verdict(check_of(test::leaning_prism(10, 30, 40, critical_lean + 0.02)));
  EXPECT_EQ(text, "Falls: tips over to the +x side, -0.029 degrees (10.0 asked)");
}

TEST(ReportText, SaysWhenNothingCouldStandOnTheContacts) {
  Report report = check_of(test::box({0, 0, 0}, {4, 30, 60}));
  report.before.stability.can_stand = false;
  EXPECT_TRUE(verdict(report).starts_with("Cannot stand: "));
}

TEST(ReportText, OffersAPedestalOnlyWhereOneIsNeeded) {
  EXPECT_NE(to_text(check_of(test::leaning_prism(10, 30, 40, 20))).find("pedestal"), std::string::npos);
  EXPECT_EQ(to_text(check_of(test::box({0, 0, 0}, {20, 30, 20}))).find("pedestal"), std::string::npos);
}

TEST(DirectionWord, NamesTheNearestAxesOrDiagonal) {
  EXPECT_EQ(direction_word({1, 0, 0}), "+x");
  EXPECT_EQ(direction_word({0.1, -1, 0}), "-y");
  EXPECT_EQ(direction_word({0.7, -0.6, 0}), "+x-y");
  EXPECT_EQ(direction_word({0, 0, -3}), "-z");
}

TEST(HintText, NamesTheFlag) {
  EXPECT_EQ(to_text(RestingHint{Vec3{0, 1, 0}, -40 * degree, 8.5 * degree}),
            "it seems to lie: with --up y it would stand by itself (8.5 degrees instead of -40.0)");
  EXPECT_NE(to_text(RestingHint{Vec3{0, -1, 0}, 0, 0}).find("--up -y "), std::string::npos);
}

}  // namespace
}  // namespace aplomb
