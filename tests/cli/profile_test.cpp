#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

class ProfileFlag : public CommandLine {
 protected:
  /// A profile of PrusaSlicer with thin walls and little infill.
  std::string sparse() const {
    std::ofstream(path("sparse.ini"))
        << "perimeters = 2\nfill_density = 10%\nlayer_height = 0.2\nfirst_layer_height = 0.2\n"
           "top_solid_layers = 4\nbottom_solid_layers = 4\nfilament_density = 1.3\n";
    return path("sparse.ini");
  }
  nlohmann::json report() const { return nlohmann::json::parse(text_of("r.json")); }
};

TEST_F(ProfileFlag, CheckMeasuresTheModelAsItIsSliced) {
  const std::string cube = write("cube.stl", test::box({0, 0, 0}, {30, 30, 30}));
  ASSERT_EQ(run("check " + cube + " --report " + path("r.json")), 0);
  const auto solid = report().at("before");
  ASSERT_EQ(run("check " + cube + " --profile " + sparse() + " --report " + path("r.json")), 0) << text_of("stderr");
  const auto sliced = report().at("before");
  EXPECT_LT(sliced.at("mass_g"), 0.5 * solid.at("mass_g").get<double>());
  EXPECT_NEAR(sliced.at("mass_g").get<double>() / sliced.at("volume_mm3").get<double>(), 1.3e-3, 1e-9);
  EXPECT_EQ(sliced.at("box_mm"), solid.at("box_mm"));
}

TEST_F(ProfileFlag, StandWarnsWhereAVoidAddsMassAndJudgesTheSlicedPrint) {
  const std::string stand = "stand " + toppling() + " --tip 6deg --report " + path("r.json") + " -o " +
                            path("out.stl") + " --profile " + sparse();
  EXPECT_EQ(run(stand), 3) << text_of("stderr");
  EXPECT_FALSE(fs::exists(path("out.stl")));
  EXPECT_EQ(run(stand + " --best-effort"), 3);
  EXPECT_TRUE(fs::exists(path("out.stl")));
  EXPECT_NE(text_of("stderr").find("it becomes heavier"), std::string::npos) << text_of("stderr");
  EXPECT_GT(report().at("after").at("mass_g"), report().at("before").at("mass_g"));
  EXPECT_LT(report().at("after").at("tip_deg"), 6);
}

TEST_F(ProfileFlag, WhatIsNoProfileEndsInOneLineAndNoOutput) {
  const auto expect_refused = [this](const std::string& profile, const std::string& words) {
    const std::string stand = "stand " + toppling() + " -o " + path("out.stl") + " --report " + path("r.json");
    EXPECT_EQ(run(stand + " --profile " + profile), 2) << text_of("stderr");
    const std::string said = text_of("stderr");
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    EXPECT_TRUE(said.ends_with('\n')) << said;
    EXPECT_NE(said.find(words), said.npos) << said;
    EXPECT_NE(said.find("; "), said.npos) << said;
    EXPECT_EQ(text_of("stdout"), "");
    EXPECT_FALSE(fs::exists(path("out.stl")) || fs::exists(path("r.json"))) << profile;
  };
  const auto write_text = [this](const std::string& text) {
    std::ofstream(path("p.ini"), std::ios::binary) << text;
    return path("p.ini");
  };
  expect_refused(path("none.ini"), "cannot be read");
  expect_refused(path("leaning.stl"), "no profile of PrusaSlicer");
  expect_refused(write_text("perimeters = 2\nfill_density = 15%\nlayer_height = 0,2\n"),
                 "p.ini: line 3: layer_height is '0,2'");
  expect_refused(write_text("wall_line_count = 2\nlayer_height = =0.1 * 2\n"),
                 "line 2: layer_height is '=0.1 * 2', an expression");
  expect_refused(write_text("\xFF\xFEp"), "byte 0: the text is UTF-16");
}

}  // namespace
}  // namespace aplomb
