#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

class ValidateCommand : public CommandLine {};

TEST_F(ValidateCommand, SaysWhetherItPrintsAndWhatIsInTheWay) {
  const std::string sound = write("sound.stl", test::box({0, 0, 0}, {20, 20, 20}));
  EXPECT_EQ(run("validate " + sound), 0);
  EXPECT_NE(text_of("stdout").find("Prints (fdm): no check fails"), std::string::npos) << text_of("stdout");
  const std::string column = write("column.stl", test::box({0, 0, 0}, {10, 10, 100}));
  EXPECT_EQ(run("validate " + column), 6);
  EXPECT_NE(text_of("stdout").find("stand.nominal   tip angle: 5.711 deg; at least 10 deg"), std::string::npos)
      << text_of("stdout");
  EXPECT_EQ(run("validate " + column + " --tip 5deg"), 0);
  EXPECT_EQ(run("validate " + column + " --limit stand.nominal=5 --waive stand.robust"), 0);
}

TEST_F(ValidateCommand, JudgesABrokenMeshAsItIs) {
  TriangleMesh open = test::box({0, 0, 0}, {20, 20, 20});
  open.triangles.pop_back();
  EXPECT_EQ(run("validate " + write("open.stl", open)), 6);
  EXPECT_NE(text_of("stdout").find("not judged, for the mesh is no solid: "), std::string::npos) << text_of("stdout");
}

TEST_F(ValidateCommand, WritesEveryCheckAndFindingAsJson) {
  const std::string column = write("column.stl", test::box({0, 0, 0}, {10, 10, 100}));
  EXPECT_EQ(run("validate " + column + " --process sla --report " + path("r.json")), 6);
  const auto report = nlohmann::json::parse(text_of("r.json"));
  EXPECT_EQ(report.at("process"), "sla");
  EXPECT_EQ(report.at("passes"), false);
  ASSERT_GE(report.at("findings").size(), 1u);
  for (const char* key : {"id", "severity", "measured", "threshold", "unit", "text", "remedy", "waiver"})
    EXPECT_TRUE(report.at("findings")[0].contains(key)) << key;
  for (const auto& check : report.at("checks")) EXPECT_TRUE(check.contains("verdict"));
}

TEST_F(ValidateCommand, RefusesWhatMakesNoSense) {
  const std::string sound = "validate " + write("sound.stl", test::box({0, 0, 0}, {20, 20, 20}));
  for (const char* flags : {" --limit wall.thin", " --limit wall.thn=1", " --waive none", " --process clay",
                            " --layer 0", " --infill much"})
    EXPECT_EQ(run(sound + flags), 1) << flags;
  EXPECT_EQ(run("validate " + path("none.stl")), 2);
}

TEST_F(ValidateCommand, IsWhatStandRefusesBy) {
  const std::string stand = "stand " + toppling() + " --tip 6deg --process sla --holes none -o " + path("out.stl");
  EXPECT_EQ(run(stand), 6);
  EXPECT_NE(text_of("stderr").find("nothing was written"), std::string::npos) << text_of("stderr");
  EXPECT_FALSE(fs::exists(path("out.stl")));
  EXPECT_EQ(run(stand + " --waive void.closed --waive void.cup --waive stand.trapped"), 0) << text_of("stderr");
  EXPECT_TRUE(fs::remove(path("out.stl")));
  EXPECT_EQ(run(stand + " --best-effort"), 6);
  EXPECT_TRUE(fs::exists(path("out.stl")));
}

/// A needle on the block breaks in either; it was so before.
TEST_F(ValidateCommand, DoesNotRefuseWhatTheModelHadAsItCame) {
  const TriangleMesh frail = joined(test::leaning_prism(28, 28, 60, 30), test::box({27, -2.5, 55}, {32, 2.5, 120}));
  const std::string stand =
      "stand " + write("frail.stl", frail) + " --tip 4deg --waive void.bridge -o " + path("out.stl");
  EXPECT_EQ(run(stand + " --report " + path("r.json")), 0) << text_of("stderr");
  const auto findings = nlohmann::json::parse(text_of("r.json")).at("judgement").at("findings");
  EXPECT_TRUE(std::ranges::any_of(findings, [](const auto& f) {
    return f.at("id") == "strength.ankle" && f.at("severity") == "fail" && f.contains("in_input");
  })) << findings;
}

}  // namespace
}  // namespace aplomb
