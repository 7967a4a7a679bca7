#include <gtest/gtest.h>

#include <map>

#include "support/gcode_files.h"

namespace aplomb {
namespace {

using test::plain_filament;
using test::plain_start;
using test::read_program;

std::map<std::string, double> masses_mg(const std::string& moves) {
  const auto plate = read_program(plain_start() + moves, plain_filament);
  std::map<std::string, double> masses;
  if (!plate) throw std::runtime_error(plate.error().message);
  for (const PrintedObject& object : plate->objects)
    masses[object.name] = std::round(1e6 * mass_of(object.body).mass_g) / 1e3;
  for (const LeftOut& part : plate->left_out) masses["less " + part.what] = std::round(1e6 * part.mass_g) / 1e3;
  return masses;
}

using Masses = std::map<std::string, double>;

TEST(GcodeLabels, ObjectsOfPrusaSlicerAreToldApart) {
  const Masses expected{{"a.stl id:0 copy 0", 4}, {"a.stl id:0 copy 1", 2}};
  EXPECT_EQ(masses_mg("; printing object a.stl id:0 copy 0\nG1 X5 E1\n; stop printing object a.stl id:0 copy 0\n"
                      "; printing object a.stl id:0 copy 1\nG1 X9 E2\n; stop printing object a.stl id:0 copy 1\n"
                      "; printing object a.stl id:0 copy 0\nG1 X5 E3\n; stop printing object a.stl id:0 copy 0\n"),
            expected);
}

TEST(GcodeLabels, ObjectsOfKlipperMarlinBambuAndCuraAreToldApart) {
  const Masses expected{{"a", 1}, {"b", 2}};
  EXPECT_EQ(masses_mg("EXCLUDE_OBJECT_DEFINE NAME=a\nEXCLUDE_OBJECT_START NAME=a\nG1 X5 E1\nEXCLUDE_OBJECT_END NAME=a\n"
                      "EXCLUDE_OBJECT_START NAME=b\nG1 X9 E2\nEXCLUDE_OBJECT_END NAME=b\n"),
            expected);
  EXPECT_EQ(masses_mg("M486 T2\nM486 S0\nM486 Aa\nM486 S-1\nM486 S1\nM486 Ab\nM486 S-1\n"
                      "M486 S0\nG1 X5 E1\nM486 S-1\nM486 S1\nG1 X9 E2\nM486 S-1\n"),
            expected);
  EXPECT_EQ(masses_mg(";MESH:models/a\nG1 X5 E1\n;MESH:NONMESH\nG1 X7\n;MESH:b\nG1 X9 E2\n;MESH:NONMESH\n"), expected);
  EXPECT_EQ(masses_mg("; start printing object, unique label id: 15\nG1 X5 E1\n"
                      "; stop printing object, unique label id: 15\n"),
            (Masses{{"object 15", 1}}));
}

TEST(GcodeLabels, AModelAndItsInfillMeshAreOneObjectWhereThatIsSaid) {
  const std::string moves = ";MESH:a.stl\nG1 X5 E1\n;MESH:dense.stl\nG1 X9 E2\n;MESH:NONMESH\nG1 X2\n";
  EXPECT_EQ(masses_mg(moves), (Masses{{"a.stl", 1}, {"dense.stl", 2}}));
  GcodeOptions as_one = plain_filament;
  as_one.is_one = true;
  const auto plate = read_program(plain_start() + moves, as_one);
  ASSERT_TRUE(plate);
  ASSERT_EQ(plate->objects.size(), 1u);
  EXPECT_EQ(plate->objects.front().name, "a.stl");
  EXPECT_NEAR(mass_of(plate->objects.front().body).mass_g, 3e-3, 1e-9);
}

TEST(GcodeLabels, TwoKindsOfLabelsForOneObjectAreOneObject) {
  EXPECT_EQ(masses_mg("; printing object a id:0 copy 0\nEXCLUDE_OBJECT_START NAME=a_0\nG1 X5 E1\n"
                      "EXCLUDE_OBJECT_END NAME=a_0\n; stop printing object a id:0 copy 0\n"),
            (Masses{{"a id:0 copy 0", 1}}));
}

TEST(GcodeLabels, WhatIsNotTheModelIsLeftOutAndTold) {
  const std::string moves =
      ";TYPE:Custom\nG1 X1 E1\n;TYPE:Skirt/Brim\nG1 X2 E2\n; printing object a\n;TYPE:Support material\nG1 X3 E3\n"
      ";TYPE:Support material interface\nG1 X4 E4\n;TYPE:External perimeter\nG1 X5 E5\n;TYPE:Wipe tower\nG1 X6 E6\n"
      ";TYPE:Overhang perimeter\nG1 X7 E7\n; stop printing object a\n";
  EXPECT_EQ(masses_mg(moves), (Masses{{"a", 12},
                                      {"less custom G-code", 1},
                                      {"less skirt or brim", 2},
                                      {"less support", 3},
                                      {"less support interface", 4},
                                      {"less prime tower", 6}}));
  EXPECT_EQ(masses_mg("G1 X1 E9\n;LAYER:0\n;TYPE:SKIRT\nG1 X2 E1\n;MESH:a\n;TYPE:WALL-OUTER\nG1 X3 E2\n;MESH:NONMESH\n"
                      ";TYPE:SUPPORT\nG1 X4 E3\n;TYPE:SUPPORT-INTERFACE\nG1 X5 E4\n;TYPE:PRIME-TOWER\nG1 X6 E5\n"),
            (Masses{{"a", 2},
                    {"less start G-code", 9},
                    {"less skirt or brim", 1},
                    {"less support", 3},
                    {"less support interface", 4},
                    {"less prime tower", 5}}));
  EXPECT_EQ(masses_mg("; FEATURE: Brim\nG1 X1 E1\n; FEATURE: Skirt\nG1 X2 E2\n; FEATURE: Outer wall\nG1 X3 E3\n"
                      "; FLUSH_START\nG1 E4\n; FLUSH_END\nG1 X4 E5\n"),
            (Masses{{"", 8}, {"less brim", 1}, {"less skirt", 2}, {"less purge", 4}}));
}

TEST(GcodeLabels, FilamentsComeFromTheSettingsBeforeOrAfterTheMoves) {
  const std::string moves = plain_start() + "T1\nG1 X5 E1\n";
  for (const std::string& program : {"; filament_density: 1.24,1.27\n; filament_diameter: 1.75,2.85\n" + moves,
                                     moves + "; filament_diameter = 1.75,2.85\n; filament_density = 1.24,1.27\n"}) {
    const auto plate = read_program(program);
    ASSERT_TRUE(plate) << plate.error().message;
    ASSERT_EQ(plate->filaments.size(), 1u);
    EXPECT_EQ(plate->filaments[0].tool, 1u);
    EXPECT_EQ(plate->filaments[0].diameter_mm, 2.85);
    EXPECT_EQ(plate->filaments[0].density_g_per_cm3, 1.27);
  }
  const auto unknown = read_program(moves + "; filament_density = 0,0\n");
  ASSERT_TRUE(unknown);
  EXPECT_FALSE(unknown->filaments[0].density_is_known);
  EXPECT_NE(unknown->notes[0].find("--diameter"), std::string::npos);
  EXPECT_EQ(test::only(read_program(moves, {{1.75}, {1.1}})).body[0].density_g_per_cm3, 1.1);
}

TEST(GcodeLabels, LayersWithoutAHeightAreToldByTheirSteps) {
  const auto height_of = [](const std::string& moves) {  // of the object's centre of mass, in um
    return std::lround(1e3 * test::mass_of_only(read_program("G90\nM83\n" + moves, plain_filament)).com_mm.z);
  };
  EXPECT_EQ(height_of("G1 Z0.3\nG1 X9 E1\nG1 Z1\nG1 Z0.5\nG1 X0 E1\n"), (150 + 400) / 2);  // hops are no layers
  EXPECT_EQ(height_of("G1 Z0.3\nG1 X9 E1\nG1 Z0.5\nG1 X0 E1\nG1 Z0.3\nG1 X9 E1\n"), 700 / 3);
  EXPECT_EQ(height_of(";HEIGHT:0.1\nG1 Z0.3\nG1 X9 E1\n"), 250);
  EXPECT_EQ(height_of(";Layer height: 0.2\nG1 Z0.2\nG1 X9 E1\nG1 X0 Z0.22 E1\n"), (100 + 110) / 2);  // a vase
}

}  // namespace
}  // namespace aplomb
