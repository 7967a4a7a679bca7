#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "aplomb/io/read_mesh.h"
#include "aplomb/mesh/mass_properties.h"
#include "cli/command_line.h"

namespace aplomb {
namespace {

using Json = nlohmann::json;

TEST_F(CommandLine, HangsABeamLevelAndTheFileItWritesDoes) {
  const std::string beam = write("beam.stl", test::box({0, 0, 0}, {40, 16, 12}));
  const std::string flags =
      " --from 21,8,12 --tilt 3deg --wall 1.6mm -o " + path("out.3mf") + " --report " + path("r.json");
  ASSERT_EQ(run("hang " + beam + flags), 0) << text_of("stderr");
  const auto report = Json::parse(text_of("r.json"));
  EXPECT_FALSE(report.contains("before"));
  const Vec3 com = moments(read_mesh(fs::path(path("out.3mf")))->objects.front().mesh).centroid_mm();
  const double tilt_deg = std::atan2(std::hypot(com.x - 21, com.y - 8), 12 - com.z) * 57.29577951308232;
  EXPECT_LE(tilt_deg, 3);
  EXPECT_NEAR(report.at("poses").at(0).at("after").at("tilt_deg").get<double>(), tilt_deg, 1e-3);
  EXPECT_EQ(text_of("stderr").rfind("Hangs level now", 0), 0u);
}

TEST_F(CommandLine, SaysWhenAPointToHangFromIsNotOnTheModel) {
  const std::string hang = "hang " + write("beam.stl", test::box({0, 0, 0}, {40, 16, 12})) + " -o " + path("out.3mf");
  const auto hints_from = [&](const std::string& point) {
    run(hang + " --tilt 20deg --from " + point);
    return text_of("stderr").find("off the model") != std::string::npos;
  };
  EXPECT_FALSE(hints_from("20,8,12"));
  EXPECT_FALSE(hints_from("20,8,8"));  // inside
  EXPECT_TRUE(hints_from("20,8,15"));
  EXPECT_NE(text_of("stderr").find("the point (20, 8, 15) mm to hang from is 3 mm off the model"), std::string::npos);
}

TEST_F(CommandLine, RefusesToHangFromNowhereOrFromThreePoints) {
  const std::string beam = write("beam.stl", test::box({0, 0, 0}, {40, 16, 12})), to = " -o " + path("out.3mf");
  EXPECT_EQ(run("hang " + beam + to), 1);
  EXPECT_EQ(run("hang " + beam + to + " --from 1,2"), 1);
  EXPECT_EQ(run("hang " + beam + to + " --from 1,2,3 --tilt 0deg"), 1);
  EXPECT_EQ(run("hang " + beam + to + " --from 1,2,3 --from 4,5,6 --from 7,8,9"), 1);
  EXPECT_EQ(run("hang " + beam + to + " --from 1,2,3 --from 1,2,9"), 1);
  EXPECT_NE(text_of("stderr").find("one above the other"), std::string::npos);
  EXPECT_EQ(run("hang " + beam + to + " --from 0,0,12 --tilt 1deg"), 3);
  EXPECT_FALSE(fs::exists(path("out.3mf")));
}

TEST_F(CommandLine, ListsTheWaysABoxCanRest) {
  EXPECT_EQ(run("poses " + write("box.stl", test::box({0, 0, 0}, {20, 30, 50})) + " --report " + path("r.json")), 0);
  EXPECT_EQ(text_of("stdout").rfind("It can rest in 6 ways", 0), 0u) << text_of("stdout");
  double chances = 0;
  const auto report = Json::parse(text_of("r.json"));
  for (const auto& pose : report.at("poses")) chances += pose.at("chance").get<double>();
  EXPECT_NEAR(chances, 1, 1e-9);
}

TEST_F(CommandLine, TurnsAModelTheWayThatPosesSays) {
  const std::string box = write("box.stl", test::box({0, 0, 0}, {20, 30, 50}));
  ASSERT_EQ(run("poses " + box + " --report -"), 0);
  const auto list = Json::parse(text_of("stdout"));
  ASSERT_EQ(list.at("poses").size(), 6u);
  for (const auto& pose : list.at("poses")) {
    const auto turns = pose.at("rotate_deg");
    run("check " + box + " --rotate " + turns[0].dump() + "," + turns[1].dump() + ",0 --report " + path("r.json"));
    const auto before = Json::parse(text_of("r.json")).at("before");
    EXPECT_NEAR(before.at("tip_deg").get<double>(), pose.at("tip_deg").get<double>(), 0.6);
    EXPECT_NEAR(before.at("com_height_mm").get<double>(), pose.at("com_height_mm").get<double>(), 1e-4);
  }
}

TEST_F(CommandLine, RunsASavedJobToTheSameBytes) {
  const std::string model = toppling();
  fs::create_directories(path("jobs"));
  const std::string stand = "stand " + model + " --rotate 0,0,33.3 --height 61.7mm --tip 4deg --process powder" +
                            " --contact 0,0,0,90 --aim light --voxel 0.7mm --material petg --memory 1GB";
  const std::string hang = "hang " + model + " --from 10,0,60 --from 22,0,60 --tilt 0.1rad --density 1.1 --best-effort";
  for (const std::string& command : {stand, hang}) {
    const int code = run(command + " -o " + path("out.3mf") + " --save-job " + path("jobs/job.json"));
    ASSERT_TRUE(fs::exists(path("out.3mf"))) << text_of("stderr");
    const std::string bytes = text_of("out.3mf");
    fs::remove(path("out.3mf"));
    EXPECT_EQ(run("run " + path("jobs/job.json")), code) << text_of("stderr");
    EXPECT_EQ(text_of("out.3mf"), bytes);
    fs::remove(path("out.3mf"));
  }
}

TEST_F(CommandLine, RunsAJobWithSeveralPosesAndChecksOneWithoutOutput) {
  write("block.stl", test::leaning_prism(30, 24, 40, 12));
  std::ofstream(path("job.json")) << R"({"aplomb_job": 1, "model": "block.stl", "poses": [
    {"name": "feet", "stand": {"tip_deg": 28}}, {"name": "head", "stand": {"up": "-z", "tip_deg": 15}}]})";
  EXPECT_EQ(run("run " + path("job.json")), 3);
  EXPECT_EQ(text_of("stdout").rfind("Does not hold all 2 poses: feet 24.", 0), 0u) << text_of("stdout");
  EXPECT_EQ(run("run " + path("job.json") + " -o " + path("out.3mf") + " --report " + path("r.json")), 0);
  const auto report = Json::parse(text_of("r.json"));
  EXPECT_EQ(report.at("poses").size(), 2u);
  for (const auto& pose : report.at("poses"))
    EXPECT_GE(pose.at("after").at("tip_deg").get<double>(), pose.at("required_tip_deg").get<double>());
  EXPECT_EQ(report.at("before"), report.at("poses")[0].at("before"));
  EXPECT_TRUE(report.at("carving").contains("bound_surplus_deg"));
}

TEST_F(CommandLine, RunsTheExamplesThatStandAndHang) {
  for (const std::string name : {"stand", "stand_and_hang"}) {
    const std::string job = std::string(APLOMB_FIXTURES) + "/jobs/" + name + ".json";
    EXPECT_EQ(run("run " + job), 3) << text_of("stdout");
    EXPECT_EQ(run("run " + job + " -o " + path("out.3mf") + " --report " + path("r.json")), 0) << text_of("stderr");
    const auto report = Json::parse(text_of("r.json"));
    for (const auto& pose : report.at("poses")) EXPECT_EQ(pose.at("holds"), true) << pose.at("name");
  }
}

TEST_F(CommandLine, SaysInOneLineWhatIsWrongWithAJob) {
  std::ofstream(path("job.json")) << R"({"aplomb_job": 1, "model": "a.stl", "poses": [{"stand": {"tip_deg": 95}}]})";
  EXPECT_EQ(run("run " + path("job.json")), 1);
  EXPECT_NE(
      text_of("stderr").find("job.json: poses[0].stand.tip_deg is 95 but must be a number at least 0 and below 90"),
      std::string::npos)
      << text_of("stderr");
  EXPECT_EQ(run("run " + path("missing.json")), 2);
}

}  // namespace
}  // namespace aplomb
