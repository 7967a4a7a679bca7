#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "aplomb/io/read_mesh.h"
#include "aplomb/io/write_mesh.h"
#include "cli/command_line.h"
#include "support/cost.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

TEST_F(CommandLine, UsageErrorsEndInOne) {
  EXPECT_EQ(run(""), 1);
  EXPECT_EQ(run("stand"), 1);
  EXPECT_EQ(run("check " + toppling() + " --tip 95deg"), 1);
  EXPECT_EQ(run("check " + toppling() + " --contact 1,2"), 1);
  EXPECT_EQ(run("stand " + toppling() + " -o " + path("out.xyz")), 1);
  EXPECT_FALSE(fs::exists(path("out.xyz")));
}

TEST_F(CommandLine, TwoOutputsThatAreOneFileAreAUsageErrorAndTouchNothing) {
  const std::string model = toppling(), stand = "stand " + model + " --tip 1deg";
  std::ofstream(path("out.stl")) << "old";
  fs::create_directory(path("sub"));
  fs::create_symlink("out.stl", path("link.stl"));
  for (const std::string flag : {"--plugs", "--report", "--modifier", "--picture", "--html", "--save-job"})
    for (const std::string& other : {path("out.stl"), path("sub/../out.stl"), path("link.stl")}) {
      EXPECT_EQ(run(stand + " -o " + path("out.stl") + " " + flag + " " + other), 1) << flag << other;
      EXPECT_NE(text_of("stderr").find("give each a file of its own"), std::string::npos) << text_of("stderr");
      EXPECT_EQ(text_of("out.stl"), "old") << flag;
    }
  EXPECT_EQ(run(stand + " -o new.stl --report ./new.stl"), 1);  // neither is there yet
  EXPECT_EQ(run(stand + " -o - --report -"), 1);
  EXPECT_NE(text_of("stderr").find("both go to standard output"), std::string::npos) << text_of("stderr");
  EXPECT_EQ(text_of("stdout"), "");
  const std::string before = text_of("leaning.stl");
  EXPECT_EQ(run("check " + model + " --report " + model), 1);
  EXPECT_EQ(text_of("leaning.stl"), before);
  EXPECT_EQ(run("check " + model + " --report /dev/null --html /dev/null"), 3) << text_of("stderr");
}

TEST_F(CommandLine, AJobIsNotReplacedByWhatItWrites) {
  const std::string job = R"({"aplomb_job": 1, "model": "leaning.stl", "poses": [{"stand": {}}]})";
  toppling();
  std::ofstream(path("job.json")) << job;
  for (const std::string flag : {"--report", "--html", "--picture"}) {
    EXPECT_EQ(run("run " + path("job.json") + " " + flag + " " + path("./job.json")), 1) << flag;
    EXPECT_NE(text_of("stderr").find("a file of its own"), std::string::npos) << text_of("stderr");
    EXPECT_EQ(text_of("job.json"), job) << flag;
  }
}

TEST_F(CommandLine, ANameThatWouldSpeakToTheTerminalIsShownWithout) {
  const std::string name = path("a\x1b]0;owned\x07.stl"), quoted = "'" + name + "'";
  EXPECT_EQ(run("check one.stl " + quoted), 1);
  EXPECT_EQ(text_of("stderr").find('\x1b'), std::string::npos) << text_of("stderr");
  EXPECT_EQ(run("check " + quoted), 2);
  EXPECT_EQ(text_of("stderr").find('\x1b'), std::string::npos) << text_of("stderr");
  std::ofstream(name) << "no mesh";
  for (const std::string command : {"check ", "verify ", "run ", "validate ", "poses "}) {
    EXPECT_NE(run(command + quoted), 0) << command;
    EXPECT_EQ(text_of("stderr").find('\x1b'), std::string::npos) << command << text_of("stderr");
  }
  EXPECT_EQ(run("stand " + toppling() + " -o " + quoted + "/x.stl"), 2);
  EXPECT_EQ(text_of("stderr").find('\x1b'), std::string::npos) << text_of("stderr");
}

TEST_F(CommandLine, InputThatCannotBeUsedEndsInTwoWithOneSentence) {
  std::ofstream(path("bad.stl")) << "this is no mesh";
  EXPECT_EQ(run("stand " + path("bad.stl") + " -o " + path("out.3mf")), 2);
  EXPECT_FALSE(fs::exists(path("out.3mf")));
  const std::string said = text_of("stderr");
  EXPECT_NE(said.find("bad.stl"), std::string::npos);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
  EXPECT_EQ(run("check " + path("missing.stl")), 2);
}

TEST_F(CommandLine, CheckSaysOnStandardOutputWhetherItStands) {
  EXPECT_EQ(run("check " + write("box.stl", test::box({0, 0, 0}, {20, 20, 20}))), 0);
  EXPECT_EQ(text_of("stdout").rfind("Stands", 0), 0u) << text_of("stdout");
  EXPECT_NE(text_of("stdout").find("45.0 degrees"), std::string::npos);
  EXPECT_EQ(run("check " + toppling()), 3);
  EXPECT_EQ(text_of("stdout").rfind("Falls", 0), 0u) << text_of("stdout");
}

TEST_F(CommandLine, WhatStandsAlreadyIsCopiedUnchanged) {
  const TriangleMesh box = test::box({1, 2, 3}, {21, 22, 23});
  EXPECT_EQ(run("stand " + write("box.stl", box) + " -o " + path("out.stl") + " --report " + path("r.json")), 0);
  EXPECT_EQ(text_of("out.stl").substr(80), text_of("box.stl").substr(80));
  EXPECT_EQ(nlohmann::json::parse(text_of("r.json")).at("outcome"), "already_stands");
}

TEST_F(CommandLine, ATopplingModelIsMadeToStandAtTheAngleAskedForAndNoMore) {
  EXPECT_EQ(run("stand " + toppling() + " --tip 4deg --wall 2mm -o " + path("out.3mf") + " --report " + path("r.json")),
            0)
      << text_of("stderr");
  const auto report = nlohmann::json::parse(text_of("r.json"));
  EXPECT_EQ(report.at("outcome"), "stands");
  EXPECT_LT(report.at("before").at("tip_deg").get<double>(), 0);
  EXPECT_NEAR(report.at("after").at("tip_deg").get<double>(), 4, 0.01);
  EXPECT_GE(report.at("after").at("tip_deg").get<double>(), 4);
  EXPECT_GE(report.at("wall_mm").at("measured").get<double>(), 2);
  EXPECT_EQ(report.at("mesh").at("outer_unchanged"), true);
  EXPECT_EQ(report.at("mesh").at("self_intersections"), 0);
  EXPECT_EQ(report.at("options").at("tip"), "4deg");
  EXPECT_EQ(run("check " + path("out.3mf") + " --tip 4deg"), 0) << text_of("stdout");
}

TEST_F(CommandLine, WhatCannotStandEndsInThreeAndWritesOnlyABestEffort) {
  const std::string model = toppling();
  EXPECT_EQ(run("stand " + model + " --tip 60deg -o " + path("out.3mf")), 3);
  EXPECT_FALSE(fs::exists(path("out.3mf")));
  EXPECT_NE(text_of("stderr").find("pedestal"), std::string::npos);
  EXPECT_EQ(run("stand " + model + " --tip 60deg --best-effort -o " + path("out.3mf")), 3);
  EXPECT_TRUE(fs::exists(path("out.3mf")));
}

TEST_F(CommandLine, AGridOverTheMemoryBudgetIsRefusedWithFive) {
  EXPECT_EQ(run("stand " + toppling() + " --voxel 0.01mm --least-void 0.1mm --memory 100MB -o " + path("out.3mf")), 5);
  EXPECT_NE(text_of("stderr").find("voxel"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("out.3mf")));
}

TEST_F(CommandLine, APipeCarriesNothingButTheMesh) {
  EXPECT_EQ(run("stand " + toppling() + " --tip 4deg -o -"), 0);
  const std::string bytes = text_of("stdout");
  const auto mesh = read_mesh(std::as_bytes(std::span(bytes)), "pipe.stl");
  ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
  EXPECT_EQ(mesh->format, "binary STL");
}

TEST_F(CommandLine, SeveralPrintsAreNamedAndOneIsChosen) {
  const TriangleMesh two = joined(test::box({0, 0, 0}, {10, 10, 10}), test::box({20, 0, 0}, {24, 10, 40}));
  const std::string model = write("two.stl", two);
  EXPECT_EQ(run("check " + model), 2);
  EXPECT_NE(text_of("stderr").find("--object"), std::string::npos);
  EXPECT_EQ(run("check --object 1 " + model), 0);
  EXPECT_EQ(run("check --object 2 " + model), 3);  // 4 wide and 40 high: 5.7 degrees
}

TEST_F(CommandLine, CtrlCEndsWithinTwoHundredMillisecondsWithFourAndNoFile) {
  const std::string model = toppling(), output = path("out.3mf"), dump = path("dump");
  const auto seconds_to_the_end = [&] {
    fs::remove_all(dump);
    const pid_t child = fork();
    if (child == 0) {
      execl(APLOMB_CLI, APLOMB_CLI, "stand", model.c_str(), "--voxel", "0.05mm", "--memory", "20GB", "-q", "--dump",
            dump.c_str(), "-o", output.c_str(), nullptr);
      _exit(127);
    }
    for (int waits = 0; waits < 6000 && !fs::exists(dump + "/3-solid.ply"); ++waits) usleep(10'000);
    EXPECT_TRUE(fs::exists(dump + "/3-solid.ply"));
    usleep(100'000);  // by now it samples the volume, which takes half a minute
    const auto start = std::chrono::steady_clock::now();
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 4);
    for (const auto& entry : fs::directory_iterator(folder_))
      EXPECT_EQ(entry.path().filename().string().find("out"), std::string::npos);
    return waited.count();
  };
  constexpr double most_s = 0.5;  // 150 ms is the program's own limit; the rest is the machine's
  EXPECT_LT(test::least_seconds(seconds_to_the_end, most_s), most_s);
}

TEST_F(CommandLine, EndsWithFiveAndWithoutOutputWhereTheTimeOrTheTrianglesAreOverWhatMayBe) {
  const std::string stand = "stand " + toppling() + " --tip 6deg -o " + path("out.3mf");
  EXPECT_EQ(run(stand + " --time 20ms"), 5);
  EXPECT_NE(text_of("stderr").find("the time is over (--time)"), std::string::npos) << text_of("stderr");
  for (const char* few : {"1", "6", "11"}) EXPECT_EQ(run(stand + " --max-triangles " + few), 5) << few;  // of 12
  EXPECT_FALSE(fs::exists(path("out.3mf")));
  EXPECT_EQ(run(stand + " --time 10min --max-triangles 12"), 0) << text_of("stderr");
  EXPECT_TRUE(fs::exists(path("out.3mf")));
  EXPECT_EQ(run(stand + " --max-triangles 13"), 0);
  EXPECT_EQ(run(stand + " --time 0s"), 1);
  EXPECT_EQ(run(stand + " --time soon"), 1);
}

}  // namespace
}  // namespace aplomb
