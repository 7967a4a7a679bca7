// Job files that are none, through the program: exit code 2, one line with the place, no output.
#include <algorithm>

#include "cli/command_line.h"

namespace aplomb {
namespace {

class JobRefusals : public CommandLine {
 protected:
  void expect_refused(const std::string& text, int code, const std::string& words) const {
    std::ofstream(path("job.json"), std::ios::binary) << text;
    EXPECT_EQ(run("run " + path("job.json")), code) << text.substr(0, 200) << text_of("stderr");
    const std::string said = text_of("stderr");
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    EXPECT_TRUE(said.ends_with('\n')) << said;
    EXPECT_NE(said.find(words), said.npos) << said;
    EXPECT_EQ(text_of("stdout"), "");
    EXPECT_FALSE(fs::exists(path("out.3mf")));
  }
  static std::string job(const std::string& more) {
    return R"({"aplomb_job": 1, "model": "none.stl", "output": "out.3mf")" + more + "}";
  }
};

TEST_F(JobRefusals, EndInOneLineAndNoOutput) {
  expect_refused("", 1, "the job is no JSON");
  expect_refused(job(", \"wall_mm\": -1"), 1, "wall_mm is -1 but must be");
  expect_refused(job(", \"wall\": 1"), 1, "no key 'wall'; its keys are");
  expect_refused(job(", \"\\u001b[2J\": 1"), 1, "no key '?[2J'");
  expect_refused(std::string(100'000, '['), 1, "nests deeper than 100 levels, which no job needs; ");
  expect_refused(std::string(1'000'001, ' '), 1, "longer than 1 MB, as no job is; ");
  expect_refused(job(""), 2, "none.stl");
  EXPECT_EQ(run("run " + path("no job.json").insert(0, "'") + "'"), 2) << text_of("stderr");
  EXPECT_NE(text_of("stderr").find("; check its name"), std::string::npos) << text_of("stderr");
}

}  // namespace
}  // namespace aplomb
