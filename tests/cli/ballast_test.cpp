#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "aplomb/io/read_mesh.h"
#include "cli/command_line.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

class BallastFlag : public CommandLine {
 protected:
  /// A profile with 15 % infill, of which a slicer makes more or less mass at will.
  std::string profile(const std::string& infill = "15%") const {
    std::ofstream(path("p.ini")) << "perimeters = 2\nfill_density = " << infill
                                 << "\nlayer_height = 0.2\nfirst_layer_height = 0.2\nfilament_density = 1.3\n";
    return path("p.ini");
  }
  std::string stand(const std::string& output, const std::string& flags = "", const std::string& tip = "3deg") const {
    return "stand " + toppling() + " --tip " + tip + " --report " + path("r.json") + " -o " + path(output) +
           " --profile " + profile() + " " + flags;
  }
  nlohmann::json report() const { return nlohmann::json::parse(text_of("r.json")); }
};

TEST_F(BallastFlag, SparseInfillIsMadeDenserOnOneSideAndTheModelLeavesAsItCame) {
  ASSERT_EQ(run(stand("out.3mf")), 0) << text_of("stderr");
  EXPECT_NE(text_of("stderr").find("balanced by infill, for at 15 %"), std::string::npos) << text_of("stderr");
  const auto told = report();
  EXPECT_FALSE(told.contains("carving"));
  EXPECT_EQ(told.at("ballast").at("infill_percent"), nlohmann::json({15.0, 100.0}));
  EXPECT_LT(told.at("before").at("tip_deg"), 3);
  EXPECT_GE(told.at("after").at("tip_deg"), 3);
  EXPECT_LE(told.at("after").at("tip_deg"), told.at("ballast").at("bound_deg").get<double>() + 0.2);
  EXPECT_NEAR(told.at("after").at("mass_g").get<double>() - told.at("before").at("mass_g").get<double>(),
              told.at("ballast").at("added_g"), 1e-6);
  EXPECT_TRUE(told.at("mesh").at("outer_unchanged").get<bool>());
  const auto back = read_mesh(path("out.3mf")), came = read_mesh(path("leaning.stl"));
  EXPECT_EQ(back->objects.front().mesh.triangles.size(), came->objects.front().mesh.triangles.size());
}

TEST_F(BallastFlag, TheJudgeWeighsWhatIsPrintedAndNotASolid) {
  for (const char* flags : {"", "--no-ballast --wall 4mm --voxel 2mm --best-effort"}) {
    run(stand("out.3mf", flags));
    const auto told = report();
    int angles = 0;
    for (const auto& check : told.at("judgement").at("checks"))
      for (const auto& [id, angle] :
           {std::pair{"stand.nominal", "tip_deg"}, std::pair{"stand.robust", "robust_tip_deg"}})
        if (check.at("id") == id) {
          EXPECT_NEAR(check.at("measured"), told.at("after").at(angle), 1e-6) << id << ", " << flags;
          ++angles;
        }
    EXPECT_EQ(angles, 2);
  }
}

TEST_F(BallastFlag, TheDenseVolumeIsWrittenOnItsOwn) {
  ASSERT_EQ(run(stand("out.stl", "--modifier " + path("dense.stl"))), 0) << text_of("stderr");
  const auto dense = read_mesh(path("dense.stl"));
  ASSERT_TRUE(dense);
  const auto form = report().at("ballast").at("dense");
  for (const Vec3& v : dense->objects.front().mesh.vertices) {
    const auto& g = form.at("gradient");
    const double value = form.at("constant").get<double>() + g[0].get<double>() * v.x + g[1].get<double>() * v.y +
                         g[2].get<double>() * v.z;
    EXPECT_GE(value, -1e-3 * std::abs(form.at("constant").get<double>()));
  }
}

TEST_F(BallastFlag, WhatCannotHoldItIsRefusedOrCarved) {
  EXPECT_EQ(run(stand("out.stl", "--ballast")), 1);
  EXPECT_NE(text_of("stderr").find("cannot hold ballast"), std::string::npos) << text_of("stderr");
  EXPECT_EQ(run("stand " + toppling() + " --ballast -o " + path("o.3mf")), 1);
  EXPECT_NE(text_of("stderr").find("name the profile"), std::string::npos) << text_of("stderr");
  run(stand("out.stl", "--wall 4mm --voxel 2mm"));
  EXPECT_TRUE(report().contains("carving"));
  run(stand("out.3mf", "--no-ballast --wall 4mm --voxel 2mm"));
  EXPECT_TRUE(report().contains("carving"));
}

TEST_F(BallastFlag, DensitiesThatCannotBeAreNamed) {
  EXPECT_EQ(run(stand("out.3mf", "--ballast-low 2%")), 1);
  EXPECT_NE(text_of("stderr").find("ballast_low_ratio is 0.02"), std::string::npos) << text_of("stderr");
  EXPECT_EQ(run(stand("out.3mf", "--ballast-low 50% --ballast-high 40%")), 1);
  const std::string hollow = " --ballast --profile " + profile("0%") + " -o " + path("o.3mf");
  EXPECT_EQ(run("stand " + toppling() + hollow), 1);
  EXPECT_NE(text_of("stderr").find("needs at least 5 %"), std::string::npos) << text_of("stderr");
}

TEST_F(BallastFlag, WhatItDoesNotReachIsSaid) {
  EXPECT_EQ(run(stand("out.3mf", "--ballast", "60deg")), 3);
  EXPECT_FALSE(fs::exists(path("out.3mf")));
  EXPECT_LT(report().at("ballast").at("bound_deg"), 60);
}

TEST_F(BallastFlag, AJobFileHoldsProfileAndBallast) {
  ASSERT_EQ(run(stand("a.3mf", "--ballast-low 10% --flavor orca --save-job " + path("j.json"))), 0);
  const std::string first = text_of("a.3mf");
  ASSERT_EQ(run("run " + path("j.json")), 0) << text_of("stderr");
  EXPECT_EQ(text_of("a.3mf"), first);
}

}  // namespace
}  // namespace aplomb
