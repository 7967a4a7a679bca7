#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

class CeilingCommand : public CommandLine {
 protected:
  /// The report of `aplomb stand` with these flags on a box that leans.
  nlohmann::json report(const std::string& flags) {
    const std::string model = write("leaning.stl", test::leaning_prism(30, 30, 50, 20));
    EXPECT_EQ(run("stand " + model + " -o " + path("out.stl") + " --report " + path("r.json") +
                  " --aim stable --wall 2mm --voxel 0.8mm " + flags),
              0)
        << text_of("stderr");
    return nlohmann::json::parse(text_of("r.json"));
  }

  static bool warns_of_ceilings(const nlohmann::json& report) {
    for (const auto& finding : report.at("judgement").at("findings"))
      if (finding.at("id") == "void.slope" || finding.at("id") == "void.bridge") return true;
    return false;
  }
};

TEST_F(CeilingCommand, ShapesCeilingsByDefaultAndReportsWhatItCost) {
  const auto any = report("--ceiling any --waive void.bridge"), shaped = report("");
  EXPECT_TRUE(warns_of_ceilings(any));
  EXPECT_FALSE(warns_of_ceilings(shaped));
  EXPECT_FALSE(any.at("carving").contains("ceiling"));
  const auto ceiling = shaped.at("carving").at("ceiling");
  EXPECT_GT(ceiling.at("ribs"), 0);
  EXPECT_EQ(ceiling.at("findings_left"), 0);
  EXPECT_NEAR(ceiling.at("bound_deg"), any.at("carving").at("bound_deg"), 1e-6);
  EXPECT_GT(ceiling.at("cost_deg"), 0);
  EXPECT_LE(shaped.at("after").at("tip_deg"), any.at("after").at("tip_deg"));
}

TEST_F(CeilingCommand, LeavesCeilingsToOtherProcessesUnlessAsked) {
  EXPECT_FALSE(report("--process powder").at("carving").contains("ceiling"));
  EXPECT_TRUE(report("--process sla --ceiling auto").at("carving").contains("ceiling"));
}

}  // namespace
}  // namespace aplomb
