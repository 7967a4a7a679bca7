#include "aplomb/inserts/pocket.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "aplomb/inserts/pause.h"
#include "aplomb/printability/judge.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

using std::numbers::pi;

const Insert penny{"penny", Insert::Shape::disc, 19.05, 1.52, 2.5};
const Insert ball{"ball", Insert::Shape::ball, 10, 10, 4.11};

std::vector<Insert> many() {
  std::vector<Insert> inserts{penny, ball};
  for (const double diameter : {3.0, 9.0, 12.0, 25.75, 41.0})
    for (const auto shape : {Insert::Shape::disc, Insert::Shape::ball})
      inserts.push_back({"some", shape, diameter, shape == Insert::Shape::disc ? 0.1 * diameter : diameter, 1});
  return inserts;
}

/// The radius of the pocket's space at a height, where it is narrowest there.
double room_at(const Pocket& pocket, double height) {
  double room = 1e9;
  for (std::size_t i = 0; i + 1 < pocket.profile.size(); ++i) {
    const auto [r, z] = pocket.profile[i];
    const auto [s, w] = pocket.profile[i + 1];
    if (w > z && height >= z && height <= w) room = std::min(room, r + (s - r) * (height - z) / (w - z));
  }
  return room;
}

TEST(ParseInsert, ReadsCoinsBallsAndDiscs) {
  EXPECT_EQ(parse_insert("penny:4").value(), (InsertStock{penny, 4}));
  EXPECT_EQ(parse_insert("penny")->most, 1);
  const InsertStock balls = parse_insert("ball:10mm:6").value();
  EXPECT_EQ(balls.most, 6);
  EXPECT_NEAR(balls.insert.mass_g, 7.85e-3 * pi * 1000 / 6, 1e-12);
  EXPECT_EQ(parse_insert("ball:10:2.5g:3")->insert.mass_g, 2.5);
  EXPECT_EQ(parse_insert("ball:10:2.5g:3")->most, 3);
  const InsertStock coin = parse_insert("coin:23.25x2.33mm:7.5g:2").value();
  EXPECT_EQ(coin.insert.diameter_mm, 23.25);
  EXPECT_EQ(coin.insert.height_mm, 2.33);
  EXPECT_EQ(coin.insert.mass_g, 7.5);
  EXPECT_NEAR(parse_insert("coin:20x3mm")->insert.mass_g, 7.85e-3 * pi * 100 * 3, 1e-12);
}

TEST(ParseInsert, SaysWhatIsWrong) {
  for (const char* text : {"", "pence:4", "penny:x", "penny:1.5", "penny:4:4", "ball", "ball:", "ball:10cm",
                           "ball:10mm:", "coin:10mm", "coin:10x2mm:5g:1:1", "ball:nan", "ball:1e999"}) {
    const auto stock = parse_insert(text);
    ASSERT_FALSE(stock) << text;
    EXPECT_EQ(stock.error().code, ErrorCode::invalid_option);
    EXPECT_NE(stock.error().message.find("ball:10mm:6"), std::string::npos) << stock.error().message;
  }
  EXPECT_NE(parse_insert("ball:-3mm").error().message.find("-3 mm; it must lie in [0.5, 500]"), std::string::npos);
  EXPECT_NE(parse_insert("coin:20x0mm").error().message.find("height is 0 mm"), std::string::npos);
  EXPECT_NE(parse_insert("ball:10mm:0").error().message.find("1 to 100"), std::string::npos);
  EXPECT_NE(parse_insert("ball:10mm:90g").error().message.find("g/cm3"), std::string::npos);
  EXPECT_FALSE(parse_insert("ball:10mm:-2g"));
}

TEST(Pocket, HasTheMomentsOfItsMesh) {
  const Vec3 floor{12.5, -7, 3.25};
  for (const Insert& insert : many())
    for (const int stacked : {1, 3}) {
      const Pocket pocket = pocket_for(insert, stacked, {});
      const Moments by_mesh = moments(pocket_mesh(pocket, floor)), closed = pocket_moments(pocket, floor);
      EXPECT_NEAR(closed.volume_mm3, by_mesh.volume_mm3, 1e-9 * by_mesh.volume_mm3);
      EXPECT_LT(norm(closed.first_mm4 - by_mesh.first_mm4), 1e-9 * norm(by_mesh.first_mm4));
      EXPECT_GT(closed.volume_mm3, stacked * volume_mm3(insert));
    }
}

TEST(Pocket, OfAPennyIsACylinderUnderTwoRings) {
  const Pocket pocket = pocket_for(penny, 4, {});
  EXPECT_DOUBLE_EQ(pocket.radius_mm, 9.775);
  EXPECT_NEAR(pocket.open_mm, 6.2, 1e-12);  // 6.08 and 0.05, in layers
  EXPECT_NEAR(pocket.height_mm, 6.6, 1e-12);
  EXPECT_DOUBLE_EQ(pocket.inserts_at_mm, 3.04);
  const double middle = (9.775 + 4.7) / 2, k = 64 * std::tan(pi / 64);
  const double volume = k * (9.775 * 9.775 * 6.2 + (middle * middle + 4.7 * 4.7) * 0.2);
  EXPECT_NEAR(pocket_moments(pocket, {}).volume_mm3, volume, 1e-9 * volume);
}

TEST(Pocket, HoldsItsInsertsBelowTheCeilingWithRoomBeside) {
  for (const Insert& insert : many())
    for (const double layer : {0.1, 0.2, 0.32})
      for (const int stacked : {1, 2, 5}) {
        const Pocket pocket = pocket_for(insert, stacked, {.layer_mm = layer});
        const double lifted = insert.shape == Insert::Shape::ball ? layer / 2 : 0;
        EXPECT_GE(pocket.open_mm, stacked * insert.height_mm + lifted + 0.05 - 1e-9);
        EXPECT_LT(pocket.open_mm, stacked * insert.height_mm + lifted + 0.05 + layer);
        EXPECT_NEAR(std::remainder(pocket.open_mm, layer), 0, 1e-9);
        EXPECT_NEAR(std::remainder(pocket.height_mm, layer), 0, 1e-9);
        for (double above = 0.01; above < stacked * insert.height_mm; above += 0.013) {
          const double up = above + lifted, radius = insert.diameter_mm / 2,
                       off = radius - std::fmod(above, 2 * radius);
          const double needed = insert.shape == Insert::Shape::disc ? radius : std::sqrt(radius * radius - off * off);
          ASSERT_GE(room_at(pocket, up), needed) << insert.diameter_mm << " at " << up;
        }
      }
}

/// The judge knows of no insert that would hold a ceiling.
TEST(Pocket, HasACeilingAndAFloorThatPrint) {
  for (const Insert& insert : many()) {
    const Pocket pocket = pocket_for(insert, 1, {});
    const double half = pocket.radius_mm + 3, top = pocket.height_mm + 4;
    const auto made =
        judge(test::with_void(test::box({-half, -half, 0}, {half, half, top}), pocket_mesh(pocket, {0, 0, 2})),
              JudgeOptions{});
    ASSERT_TRUE(made.has_value());
    for (const CheckResult& check : made->checks)
      if (check.id.starts_with("void.") && check.id != "void.closed") {
        EXPECT_EQ(check.verdict, CheckResult::Verdict::passed)
            << check.id << " " << check.measured << " over an insert " << insert.diameter_mm << " mm across";
      }
  }
}

TEST(Pocket, HasASurfaceThatBoundsASolid) {
  for (const Insert& insert : many()) {
    const auto made = check_solid(pocket_mesh(pocket_for(insert, 2, {}), {1, 2, 3})).value();
    EXPECT_TRUE(made.solid) << describe(made.defects);
  }
}

TEST(Pauses, AreOnePerLayerTheLowestFirst) {
  const std::string xml = prusaslicer_pauses({{12.4, "put a ball in"}, {8.2, "<a> & \"b\""}, {12.4, "and a penny"}});
  EXPECT_EQ(xml,
            "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<custom_gcodes_per_print_z>\n"
            "<code print_z=\"8.2\" type=\"1\" extruder=\"1\" color=\"\" extra=\"&lt;a> &amp; &quot;b&quot;\" "
            "gcode=\"M601\"/>\n"
            "<code print_z=\"12.4\" type=\"1\" extruder=\"1\" color=\"\" extra=\"put a ball in, and a penny\" "
            "gcode=\"M601\"/>\n"
            "<mode value=\"SingleExtruder\"/>\n</custom_gcodes_per_print_z>\n");
}

}  // namespace
}  // namespace aplomb
