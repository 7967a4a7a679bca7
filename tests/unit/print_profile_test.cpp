#include "aplomb/fdm/print_profile.h"

#include <gtest/gtest.h>

namespace aplomb {
namespace {

const std::string prusaslicer = "perimeters = 2\nfill_density = 15%\nlayer_height = 0.2\nnozzle_diameter = 0.4,0.4\n";

TEST(PrintProfile, ReadsPrusaSlicersOwnRules) {
  const auto p = parse_profile(prusaslicer +
                               "first_layer_height = 150%\nexternal_perimeter_extrusion_width = 0.5\n"
                               "infill_extrusion_width = 200%\nextrusion_width = 0\ntop_solid_layers = 3\n"
                               "top_solid_min_thickness = 1\nbottom_solid_layers = 0\nbottom_solid_min_thickness = 1\n"
                               "infill_overlap = 0.07\nfilament_density = 1.27\nfill_pattern = gyroid\n");
  ASSERT_TRUE(p) << p.error().message;
  EXPECT_EQ(p->rules, PrintProfile::Rules::prusaslicer);
  EXPECT_EQ(p->perimeters, 2);
  EXPECT_DOUBLE_EQ(p->infill_ratio, 0.15);
  EXPECT_DOUBLE_EQ(p->first_layer_mm, 0.3);
  EXPECT_DOUBLE_EQ(p->external_width_mm, 0.5);
  EXPECT_DOUBLE_EQ(p->perimeter_width_mm, 0.45);  // 1.125 nozzles
  EXPECT_DOUBLE_EQ(p->infill_width_mm, 0.4);      // twice the layer
  EXPECT_EQ(p->top_layers, 5);
  EXPECT_EQ(p->bottom_layers, 0);
  EXPECT_DOUBLE_EQ(p->infill_overlap_mm, 0.07);
  EXPECT_DOUBLE_EQ(p->density_g_per_cm3, 1.27);
  EXPECT_EQ(p->infill_pattern, "gyroid");
}

TEST(PrintProfile, KnowsShellThicknessAsASwitchAndAsAChoice) {
  for (const auto& [written, expected] : {std::pair{"0", false}, std::pair{"1", true}, std::pair{"disabled", false},
                                          std::pair{"partial", true}, std::pair{"enabled", true}}) {
    const auto p = parse_profile(prusaslicer + "ensure_vertical_shell_thickness = " + written + "\n");
    ASSERT_TRUE(p) << p.error().message;
    EXPECT_EQ(p->ensures_shell_thickness, expected) << written;
  }
  EXPECT_FALSE(parse_profile(prusaslicer + "ensure_vertical_shell_thickness = perhaps\n"));
}

TEST(PrintProfile, IsTheSameInAnIniAndInTheCommentsOfGcode) {
  std::string comments = "G1 X1 ; move = 1\n";
  for (std::size_t at = 0; at < prusaslicer.size(); at = prusaslicer.find('\n', at) + 1)
    comments += "; " + prusaslicer.substr(at, prusaslicer.find('\n', at) - at) + "\r\n";
  const auto ini = parse_profile(prusaslicer), gcode = parse_profile(comments);
  ASSERT_TRUE(ini && gcode);
  EXPECT_EQ(gcode->perimeters, ini->perimeters);
  EXPECT_EQ(gcode->layer_mm, ini->layer_mm);
  EXPECT_EQ(gcode->infill_ratio, ini->infill_ratio);
}

TEST(PrintProfile, IsTheSameAsCurasJsonAndLines) {
  const auto json =
      parse_profile(R"({"wall_line_count": 3, "layer_height": 0.1, "layer_height_0": "0.3", "line_width": 0.35,
                                      "infill_sparse_density": 40, "top_bottom_thickness": 0.6, "infill_pattern": "cubic"})");
  const auto lines = parse_profile(
      "[values]\nwall_line_count = 3\nlayer_height = 0.1\nlayer_height_0 = 0.3\nline_width = 0.35\n"
      "infill_sparse_density = 40\ntop_bottom_thickness = 0.6\ninfill_pattern = cubic\n");
  ASSERT_TRUE(json && lines);
  for (const PrintProfile& p : {*json, *lines}) {
    EXPECT_EQ(p.rules, PrintProfile::Rules::cura);
    EXPECT_EQ(p.perimeters, 3);
    EXPECT_EQ(p.top_layers, 6);
    EXPECT_DOUBLE_EQ(p.first_layer_mm, 0.3);
    EXPECT_DOUBLE_EQ(p.solid_width_mm, 0.35);
    EXPECT_DOUBLE_EQ(p.infill_ratio, 0.4);
    EXPECT_EQ(p.infill_pattern, "cubic");
  }
}

TEST(PrintProfile, WhatMakesNoSenseIsNamed) {
  for (const auto& [text, word] : {std::pair<std::string, std::string>{"", "no profile"},
                                   {"{\"a\": 1}", "no profile"},
                                   {"{broken", "no profile"},
                                   {prusaslicer + "layer_height = thin\n", "layer_height is 'thin'"},
                                   {prusaslicer + "layer_height = 0\n", "layer_height comes to 0; it must be above 0"},
                                   {prusaslicer + "fill_density = 120%\n",
                                    "line 5: fill_density is '120%', which comes to 1.2; it must be from 0 to 100 %"},
                                   {prusaslicer + "perimeters = -1\n", "line 5: perimeters is '-1'"},
                                   {prusaslicer + "filament_density = -1\n", "line 5: filament_density is '-1'"}}) {
    const auto p = parse_profile(text);
    ASSERT_FALSE(p) << text;
    EXPECT_EQ(p.error().code, ErrorCode::unusable_input);
    EXPECT_NE(p.error().message.find(word), std::string::npos) << p.error().message;
  }
  EXPECT_EQ(read_profile("no such.ini").error().code, ErrorCode::file_system);
  EXPECT_EQ(read_profile(".").error().code, ErrorCode::file_system);
}

}  // namespace
}  // namespace aplomb
