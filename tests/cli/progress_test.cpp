#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/command_line.h"

namespace aplomb {
namespace {

TEST_F(CommandLine, ProgressForProgramsIsALineOfJsonEachTimeAndNothingElse) {
  ASSERT_EQ(run("stand " + toppling() + " -o " + path("out.stl") + " --progress json -q"), 0);
  std::istringstream lines(text_of("stderr"));
  std::set<std::string> stages;
  for (std::string line; std::getline(lines, line);) {
    const auto told = nlohmann::json::parse(line);
    EXPECT_GE(told.at("progress").get<double>(), 0) << line;
    EXPECT_LE(told.at("progress").get<double>(), 1) << line;
    stages.insert(told.at("stage").get<std::string>());
  }
  EXPECT_GE(stages.size(), 2u);
}

TEST_F(CommandLine, WithoutATerminalProgressIsToldOnlyWhereItIsAskedFor) {
  ASSERT_EQ(run("stand " + toppling() + " -o " + path("out.stl") + " -q"), 0);
  EXPECT_EQ(text_of("stderr"), "");
  EXPECT_EQ(run("check " + toppling() + " --progress often"), 1);
}

}  // namespace
}  // namespace aplomb
