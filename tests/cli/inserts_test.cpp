#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

class InsertFlag : public CommandLine {
 protected:
  std::string leaning() const { return write("block.stl", test::leaning_prism(34, 40, 60, 26)); }
  std::string stand(const std::string& output) const {
    return "stand " + leaning() + " --tip 10.5deg --insert ball:10mm:8 --report " + path("r.json") + " -o " +
           path(output);
  }
  nlohmann::json report() const { return nlohmann::json::parse(text_of("r.json")); }
};

TEST_F(InsertFlag, ReportsPocketsAndPausesAsTextAndJson) {
  ASSERT_EQ(run(stand("out.3mf")), 0) << text_of("stderr");
  const auto inserts = report().at("inserts");
  EXPECT_EQ(inserts.at("allowed"), 8);
  int count = 0;
  for (const auto& pocket : inserts.at("pockets")) {
    count += pocket.at("count").get<int>();
    EXPECT_EQ(pocket.at("name"), "ball 10 mm");
    EXPECT_GT(pocket.at("pause_mm"), pocket.at("floor_mm"));
    EXPECT_NEAR(pocket.at("first_print_mm").get<double>(), pocket.at("pause_mm").get<double>() + 0.2, 1e-9);
  }
  EXPECT_EQ(inserts.at("count"), count);
  EXPECT_GE(inserts.at("bound_deg"), inserts.at("reached_deg"));
  const std::string text = text_of("stderr");
  EXPECT_NE(text.find("pause at z = "), std::string::npos) << text;
  EXPECT_NE(text.find("PrusaSlicer finds the pauses in the 3MF"), std::string::npos) << text;
  const double mass =
      report().at("after").at("mass_g").get<double>() - report().at("before").at("mass_g").get<double>();
  EXPECT_GT(mass, count * (4.11 - 1.05));  // less the pockets, of some 810 mm3
}

TEST_F(InsertFlag, GivesPausesToThe3mfAndTheSameModelToOtherFormats) {
  ASSERT_EQ(run(stand("out.3mf")), 0);
  ASSERT_EQ(run(stand("out.stl")), 0);
  EXPECT_NE(text_of("stderr").find("set the pauses at these heights"), std::string::npos) << text_of("stderr");
  EXPECT_NE(text_of("out.3mf").find("Metadata/Prusa_Slicer_custom_gcode_per_print_z.xml"), std::string::npos);
  const std::string check = "check --tip 10.5deg ";  // empty pockets make it no better
  ASSERT_EQ(run(check + path("out.3mf") + " --report " + path("a.json")), 3);
  ASSERT_EQ(run(check + path("out.stl") + " --report " + path("b.json")), 3);
  EXPECT_EQ(nlohmann::json::parse(text_of("a.json")).at("before").at("volume_mm3"),
            nlohmann::json::parse(text_of("b.json")).at("before").at("volume_mm3"));
}

TEST_F(InsertFlag, LeavesPausesOutWithoutInserts) {
  ASSERT_EQ(run("stand " + leaning() + " --tip 10.5deg -o " + path("out.3mf")), 0);
  EXPECT_EQ(text_of("out.3mf").find("custom_gcode"), std::string::npos);
}

TEST_F(InsertFlag, IsKeptByAJob) {
  ASSERT_EQ(run(stand("out.3mf") + " --save-job " + path("job.json")), 0);
  const auto before = report();
  EXPECT_EQ(nlohmann::json::parse(text_of("job.json")).at("inserts"), nlohmann::json::array({"ball:10mm:8"}));
  ASSERT_EQ(run("run " + path("job.json")), 0) << text_of("stderr");
  EXPECT_EQ(report().at("inserts"), before.at("inserts"));
}

TEST_F(InsertFlag, RefusesWhatCannotBeInOneSentence) {
  const std::string start = "stand " + leaning() + " -o " + path("o.stl") + " ";
  for (const auto& [flags, exit, word] : {std::tuple{"--insert pence:4", 1, "it is none of penny:4"},
                                          {"--insert ball:0mm", 1, "must lie in [0.5, 500]"},
                                          {"--insert penny:0", 1, "1 to 100"},
                                          {"--insert penny --deform auto", 1, "--deform never"},
                                          {"--insert penny --process sla", 1, "must be fdm"},
                                          {"--insert coin:38x3mm", 2, "there is no place for"}}) {
    EXPECT_EQ(run(start + flags), exit) << flags << text_of("stderr");
    EXPECT_NE(text_of("stderr").find(word), std::string::npos) << text_of("stderr");
    EXPECT_FALSE(fs::exists(path("o.stl")));
  }
}

}  // namespace
}  // namespace aplomb
