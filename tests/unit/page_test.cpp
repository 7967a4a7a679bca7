#include "page.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aplomb/printability/judge.h"
#include "diagrams.h"
#include "support/shapes.h"

namespace aplomb::page {
namespace {

std::string base64_of(const std::string& text) {
  std::vector<std::byte> bytes;
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  return base64(bytes);
}

TEST(Page, EncodesBytesAsTheStandardsExamplesHaveIt) {  // RFC 4648, 10
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64({std::byte{255}, std::byte{254}, std::byte{253}}), "//79");
}

TEST(Page, EscapesWhatMarkupIsMadeOf) { EXPECT_EQ(escaped("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;"); }

TEST(Diagrams, InsetsAConvexPolygon) {
  const std::vector<Vec2> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const auto smaller = inset(square, 2);
  ASSERT_EQ(smaller.size(), 4u);
  for (const Vec2 p : smaller) {
    EXPECT_NEAR(std::abs(p.x - 5), 3, 1e-12);
    EXPECT_NEAR(std::abs(p.y - 5), 3, 1e-12);
  }
  EXPECT_TRUE(inset(square, 5.1).empty());
}

/// Of a box the tip angle towards a direction is that over the edge which a line from the middle meets.
TEST(Diagrams, GiveTheTipAngleByDirection) {
  const TriangleMesh box = test::box({-10, -20, 0}, {10, 20, 50});
  const Region body{moments(box), 1, 0};
  const Standing standing = measure_standing(box, {&body, 1}, {}).value();
  EXPECT_NEAR(tip_towards_rad(standing, {1, 0}), std::atan(10.0 / 25), 1e-9);
  EXPECT_NEAR(tip_towards_rad(standing, {0, -1}), std::atan(20.0 / 25), 1e-9);
  EXPECT_NEAR(tip_towards_rad(standing, {0.6, 0.8}), std::atan(10 / 0.6 / 25), 1e-9);
  double least = 10;
  for (int n = 0; n < 720; ++n)
    least = std::min(least, tip_towards_rad(standing, {std::cos(n * M_PI / 360), std::sin(n * M_PI / 360)}));
  EXPECT_NEAR(least, standing.stability.tip_rad, 1e-6);
}

TEST(Page, SaysTheVerdictFirstAndEveryCheckOnce) {
  const TriangleMesh box = test::box({0, 0, 0}, {10, 10, 100});
  PageContent content{.title = "a <column>", .after = &box, .poses = {Pose{}}};
  content.judgement = judge(box, {}).value();
  const std::string html = html_page(content).value();
  EXPECT_NE(html.find("<h1>Will not print as it is (fdm)</h1>\n<p class=\"model\">a &lt;column&gt;"),
            std::string::npos);
  for (const CheckResult& check : content.judgement->checks)
    EXPECT_NE(html.find("<tr><td>" + check.id + "</td>"), std::string::npos) << check.id;
  EXPECT_EQ(html.find("<script"), std::string::npos);
}

TEST(Page, NumbersPlacesAsTheyAreMarkedAndNeighboursAlike) {
  const TriangleMesh box = test::box({0, 0, 0}, {30, 30, 30});
  PageContent content{.title = "box", .after = &box, .poses = {Pose{}}};
  content.judgement.emplace();
  for (const auto& [id, z] : {std::pair("wall.thin", 1.0), {"void.island", 1.5}, {"void.bridge", 20.0}}) {
    Finding& finding = content.judgement->findings.emplace_back();
    finding.id = id;
    finding.box_mm.add(finding.at_mm = {15, 15, z});
  }
  content.judgement->findings.emplace_back().id = "bed.contact";  // the whole model
  const std::string html = html_page(content).value();
  for (const char* row : {"1</td><td>wall.thin", "1</td><td>void.island", "2</td><td>void.bridge", "></td><td>bed.co"})
    EXPECT_NE(html.find(row), std::string::npos) << row;
}

}  // namespace
}  // namespace aplomb::page
