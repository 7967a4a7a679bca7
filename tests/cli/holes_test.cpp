#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "aplomb/io/read_mesh.h"
#include "cli/command_line.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

class DrillingCommand : public CommandLine {
 protected:
  /// The report of `aplomb stand` for resin with these flags on a block that leans.
  nlohmann::json report(const std::string& flags, int exit_code = 0) {
    const std::string model = write("block.stl", test::leaning_prism(30, 30, 60, 18));
    EXPECT_EQ(run("stand " + model + " -o " + path("out.stl") + " --report " + path("r.json") +
                  " --tip 14deg --voxel 0.8mm " + flags),
              exit_code)
        << text_of("stderr");
    return nlohmann::json::parse(text_of("r.json"));
  }
  static std::set<std::string> failing(const nlohmann::json& report) {
    std::set<std::string> ids;
    for (const auto& finding : report.at("judgement").at("findings"))
      if (finding.at("severity") == "fail") ids.insert(finding.at("id").get<std::string>());
    return ids;
  }
};

TEST_F(DrillingCommand, CutsHolesThatTheJudgeAsksForAndStandsWithThem) {
  const auto closed = report("--process sla --holes none", 6);
  EXPECT_FALSE(closed.contains("holes"));
  EXPECT_TRUE(failing(closed).contains("void.closed"));
  const auto open = report("--process sla");
  EXPECT_GE(open.at("holes").size(), 2U);
  EXPECT_TRUE(failing(open).empty());
  EXPECT_GE(open.at("after").at("tip_deg").get<double>(), 14 - 1e-3);
  EXPECT_EQ(open.at("mesh").at("outer_unchanged"), false);
  EXPECT_EQ(run("check " + path("out.stl") + " --tip 13.99deg"), 0);
}

TEST_F(DrillingCommand, WritesAPlugForEachHoleThatClosesItAndNoMore) {
  const auto r = report("--process powder --wall 2mm --plugs " + path("plugs.stl"));
  const auto plugs = read_mesh(path("plugs.stl"));
  ASSERT_TRUE(plugs.has_value());
  EXPECT_EQ(test::solid_of(rounded_to_float(plugs->objects.front().mesh)).bodies(), r.at("holes").size());
}

TEST_F(DrillingCommand, CutsNoHolesWhereTheProcessAsksForNone) {
  const auto r = report("--plugs " + path("plugs.stl"));
  EXPECT_FALSE(r.contains("holes"));
  EXPECT_EQ(r.at("mesh").at("outer_unchanged"), true);
  EXPECT_FALSE(std::filesystem::exists(path("plugs.stl")));
}

TEST_F(DrillingCommand, RefusesAnotherWordForHoles) {
  EXPECT_EQ(run("stand " + write("block.stl", test::leaning_prism(30, 30, 60, 18)) + " -o out.stl --holes some"), 1);
}

}  // namespace
}  // namespace aplomb
