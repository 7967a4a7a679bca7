#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "support/gcode_files.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

/// Slices with the real PrusaSlicer, where there is one.
class VerifyCommand : public CommandLine {
 protected:
  static bool has_prusaslicer() { return std::system("command -v prusa-slicer >/dev/null") == 0; }

  int slice(const std::string& model, const std::string& flags) const {
    const std::string command =
        "prusa-slicer --export-gcode --gcode-label-objects --bed-shape 0x0,200x0,200x200,0x200 -o " +
        path("print.gcode") + " " + flags + " " + model + " >" + path("slicer") + " 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string write_program(const std::string& moves) const {
    std::ofstream(path("p.gcode"), std::ios::binary) << test::plain_start() + moves;
    return path("p.gcode");
  }
};

const char* const solid = "--fill-density 100% --fill-pattern rectilinear --infill-overlap 0% --skirts 1 ";

TEST_F(VerifyCommand, EndsWithZeroWhereThePrintStandsAndWithThreeWhereItTopples) {
  const std::string program = write_program(test::square_loop(10, 10, 10) + test::square_loop(10, 10, 10, 0.4));
  const std::string before = text_of("p.gcode");
  EXPECT_EQ(run("verify " + program), 0) << text_of("stderr");
  EXPECT_EQ(text_of("stdout").find("Stands as printed"), 0u) << text_of("stdout");
  EXPECT_EQ(run("verify " + program + " --tip 89deg"), 3);
  EXPECT_EQ(text_of("stdout").find("Would topple"), 0u) << text_of("stdout");
  EXPECT_EQ(run("verify -q " + program), 0);
  EXPECT_EQ(text_of("stdout") + text_of("stderr"), "");
  EXPECT_EQ(text_of("p.gcode"), before);
}

TEST_F(VerifyCommand, SaysWhatIsUnusable) {
  EXPECT_EQ(run("verify " + path("none.gcode")), 2);
  EXPECT_EQ(run("verify"), 1);
  const std::string program = write_program(test::square_loop(10, 10, 10));
  for (const char* flags : {" --density 0", " --diameter much", " --tip 95deg", " --max-mass-error 0", " --object 7"})
    EXPECT_EQ(run("verify " + program + flags), 1) << flags;
  std::ofstream(path("b.bgcode"), std::ios::binary) << "GCDE binary";
  EXPECT_EQ(run("verify " + path("b.bgcode")), 2);
  EXPECT_NE(text_of("stderr").find("binary G-code, which cannot be read"), std::string::npos);
  std::ofstream(path("no.json")) << "{}";
  EXPECT_EQ(run("verify " + program + " --expect " + path("no.json")), 2);
  EXPECT_NE(text_of("stderr").find("no report"), std::string::npos) << text_of("stderr");
}

TEST_F(VerifyCommand, WritesWhatItMeasuredAsJson) {
  const std::string program = write_program(";TYPE:Skirt/Brim\n" + test::square_loop(10, 10, 30) + ";TYPE:Perimeter\n" +
                                            test::square_loop(10, 10, 10));
  EXPECT_EQ(run("verify " + program + " --density 1 --report -"), 0);
  const auto report = nlohmann::json::parse(text_of("stdout"));
  EXPECT_EQ(report.at("stands"), true);
  ASSERT_EQ(report.at("objects").size(), 1u);
  EXPECT_NEAR(report.at("objects")[0].at("com_mm")[0], 10, 1e-9);
  EXPECT_NEAR(report.at("objects")[0].at("first_layer").at("bead_width_mm"), 0.4 * 2.405, 1e-2);  // 1.75 mm, not 1 mm2
  EXPECT_EQ(report.at("left_out")[0].at("what"), "skirt or brim");
  EXPECT_FALSE(report.contains("as_told"));
}

TEST_F(VerifyCommand, AgreesWithTheReportOfWhatWasSliced) {
  if (!has_prusaslicer()) GTEST_SKIP() << "no prusa-slicer";
  ASSERT_EQ(run("stand " + toppling() + " --tip 6deg -o " + path("out.stl") + " --report " + path("r.json")), 0);
  ASSERT_EQ(slice(path("out.stl"), solid), 0) << text_of("slicer");
  const std::string verify = "verify " + path("print.gcode") + " --expect " + path("r.json");
  EXPECT_EQ(run(verify + " --tip 4deg --max-mass-error 3% --max-com-error 0.3mm"), 0) << text_of("stdout");
  ASSERT_EQ(slice(path("leaning.stl"), solid), 0);
  EXPECT_EQ(run(verify + " --tip 4deg"), 3) << text_of("stdout");
}

TEST_F(VerifyCommand, EndsWithSixWhereThePrintStandsButIsNotWhatWasPromised) {
  if (!has_prusaslicer()) GTEST_SKIP() << "no prusa-slicer";
  const std::string cube = write("cube.stl", test::box({0, 0, 0}, {20, 20, 20}));
  ASSERT_EQ(run("check " + cube + " --report " + path("r.json")), 0);
  ASSERT_EQ(slice(cube, "--fill-density 10%"), 0) << text_of("slicer");
  EXPECT_EQ(run("verify " + path("print.gcode") + " --expect " + path("r.json")), 6) << text_of("stdout");
  EXPECT_NE(text_of("stdout").find("not what the report promised"), std::string::npos);
  EXPECT_EQ(run("verify " + path("print.gcode") + " --max-mass-error 70% --expect " + path("r.json")), 0);
}

TEST_F(VerifyCommand, IsAPostProcessingScriptOfPrusaSlicer) {
  if (!has_prusaslicer()) GTEST_SKIP() << "no prusa-slicer";
  const std::string script = std::string("--post-process \"") + APLOMB_CLI + " verify --tip 1deg\"";
  ASSERT_EQ(slice(write("cube.stl", test::box({0, 0, 0}, {20, 20, 20})), "--fill-density 20%"), 0) << text_of("slicer");
  const std::size_t plain_bytes = text_of("print.gcode").size();
  ASSERT_EQ(slice(path("cube.stl"), "--fill-density 20% " + script), 0) << text_of("slicer");
  EXPECT_NEAR(static_cast<double>(text_of("print.gcode").size()), static_cast<double>(plain_bytes),
              200);  // its settings
  EXPECT_EQ(slice(toppling(), solid + script), 1);
  EXPECT_NE(text_of("slicer").find("Would topple: leaning.stl"), std::string::npos) << text_of("slicer");
  EXPECT_NE(text_of("slicer").find("Error code: 3"), std::string::npos) << text_of("slicer");
}

}  // namespace
}  // namespace aplomb
