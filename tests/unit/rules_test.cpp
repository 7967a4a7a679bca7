#include "aplomb/printability/rules.h"

#include <gtest/gtest.h>

#include <set>

#include "aplomb/printability/remedies.h"

namespace aplomb {
namespace {

TEST(Rules, HaveAUniqueNameAWordAndARemedyForEveryCheck) {
  std::set<std::string_view> ids;
  for (const CheckRule& rule : check_rules()) {
    EXPECT_TRUE(ids.insert(rule.id).second) << rule.id;
    EXPECT_FALSE(rule.what.empty()) << rule.id;
    if (rule.is_check) {
      EXPECT_GT(remedy_of(rule.id).size(), 10u) << rule.id;
    }
  }
  EXPECT_GE(ids.size(), 23u);
}

TEST(Rules, AreThoseOfTheProcess) {
  EXPECT_EQ(Rules(Process::fdm).limits("wall.void_outer")->fail, 0.8);
  EXPECT_EQ(Rules(Process::binder).limits("wall.void_outer")->fail, 2.0);
  EXPECT_FALSE(Rules(Process::powder).limits("void.bridge"));
  EXPECT_EQ(Rules(Process::sla).number("void.hole_mm"), 3.5);
  for (const std::string_view name : process_names) EXPECT_TRUE(process_named(name));
  EXPECT_FALSE(process_named("clay"));
}

TEST(Rules, TakeAnotherLimitAndKeepTheMilderOnesOnItsGoodSide) {
  Rules rules(Process::fdm);
  ASSERT_TRUE(rules.set("void.bridge", 8));
  EXPECT_EQ(rules.limits("void.bridge")->fail, 8);
  EXPECT_EQ(rules.limits("void.bridge")->warn, 8);  // was 10, which is beyond
  ASSERT_TRUE(rules.set("wall.thin", 1.2));
  EXPECT_EQ(rules.limits("wall.thin")->warn, 1.2);
  EXPECT_FALSE(rules.limits("wall.thin")->fail);
  rules.adopt("wall.thin", {{}, {}, 5});
  EXPECT_EQ(rules.limits("wall.thin")->warn, 1.2);
  rules.adopt("stand.nominal", {{}, {}, 5});
  EXPECT_EQ(rules.limits("stand.nominal")->fail, 5);
}

TEST(Rules, RefuseChecksThatThereAreNot) {
  Rules rules(Process::fdm);
  EXPECT_NE(rules.set("wall.thn", 1).error().message.find("there is no check 'wall.thn'; the checks are mesh.manifold"),
            std::string::npos);
  EXPECT_EQ(rules.waive("x").error().code, ErrorCode::invalid_option);
  EXPECT_NE(rules.set("wall.thin", 1e30).error().message.find("must lie in"), std::string::npos);
  ASSERT_TRUE(rules.waive("wall.thin"));
  EXPECT_TRUE(rules.is_waived("wall.thin"));
  EXPECT_FALSE(rules.is_waived("void.bridge"));
}

}  // namespace
}  // namespace aplomb
