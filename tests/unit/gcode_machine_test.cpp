#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/gcode_files.h"

namespace aplomb {
namespace {

using test::mass_of_only;
using test::plain_filament;
using test::plain_start;
using test::read_program;

constexpr double pi = std::numbers::pi;

BodyMass mass_after_start(const std::string& moves) {
  return mass_of_only(read_program(plain_start() + moves, plain_filament));
}

void expect_alike(const BodyMass& a, const BodyMass& b, double tolerance = 1e-9) {
  EXPECT_NEAR(a.mass_g, b.mass_g, tolerance);
  EXPECT_NEAR(norm(a.com_mm - b.com_mm), 0, tolerance);
}

TEST(GcodeMachine, ABeadWeighsItsFilamentAndLiesInItsMiddleHalfALayerBelowTheNozzle) {
  const BodyMass mass = mass_after_start("G1 X10 Y4 E2\n");
  EXPECT_NEAR(mass.mass_g, 2e-3, 1e-12);
  EXPECT_NEAR(norm(mass.com_mm - Vec3{5, 2, 0.1}), 0, 1e-12);
  const BodyMass real = mass_of_only(read_program(plain_start() + "G1 X10 E2\n", {{2.85}, {1.27}}));
  EXPECT_NEAR(real.mass_g, 2 * pi / 4 * 2.85 * 2.85 * 1.27e-3, 1e-12);
}

TEST(GcodeMachine, RelativeAndAbsoluteExtrusionAreTheSame) {
  const BodyMass relative = mass_after_start("G1 X10 E2\nG1 Y10 E1\nG1 E-3\nG1 X0 Y5\nG1 E3\nG1 Y0 E0.5\n");
  const BodyMass absolute =
      mass_after_start("M82\nG92 E7\nG1 X10 E9\nG1 Y10 E10\nG1 E7\nG92 E0\nG1 X0 Y5\nG1 E3\nG1 Y0 E3.5\n");
  expect_alike(relative, absolute);
  EXPECT_NEAR(relative.mass_g, 3.5e-3, 1e-12);
}

TEST(GcodeMachine, RelativeMovesAndAMovedOriginAreTheSameAsAbsoluteOnes) {
  const BodyMass absolute = mass_after_start("G1 X10 Y2 E2\nG1 X13 Y7 E1\n");
  expect_alike(absolute, mass_after_start("G91\nG1 X10 Y2 E2\nG1 X3 Y5 E1\n"));
  expect_alike(absolute, mass_after_start("G92 X100 Y-50\nG1 X110 Y-48 E2\nG1 X113 Y-43 E1\n"));
  expect_alike(absolute, mass_after_start("M82\nG91\nG1 X10 Y2 E2\nG1 X3 Y5 E1\n"));  // G91 rules over M82
  expect_alike(absolute, mass_after_start("g1x10y2e2\nN12 G1 X 13 (to the end) Y7 E1*71\n"));
}

TEST(GcodeMachine, InchesAreMillimetresTimes254) {
  expect_alike(mass_after_start("G1 X25.4 Y50.8 E2.54\n"), mass_after_start("G20\nG1 X1 Y2 E0.1\n"));
}

TEST(GcodeMachine, WhatIsDrawnBackIsOwedBeforeAnythingIsLaidDown) {
  const BodyMass plain = mass_after_start("G1 X10 E2\nG1 X20 E2\n");
  expect_alike(plain, mass_after_start("G1 X10 E2\nG1 E-1\nG1 Z1\nG1 Z0.2\nG1 E1\nG1 X20 E2\n"));
  expect_alike(plain, mass_after_start("G1 X10 E2\nG1 X8 E-1\nG1 X10 E1\nG1 X20 E2\n"));  // wiped, and filled again
  expect_alike(plain, mass_after_start("G1 X10 E2\nG10\nG1 Z1\nG1 Z0.2\nG11\nG1 X20 E2\n"));
  expect_alike(plain, mass_after_start("G1 X10 E2\nG1 E-1\nG1 X20 E3\n"));
}

TEST(GcodeMachine, EveryToolOwesItsOwnRetractions) {
  const std::string program = plain_start() + "T0\nG1 X10 E2\nG1 E-5\nT1\nG1 X20 E3\n";
  const auto plate = read_program(program, {{1.1283791670955126}, {1.0, 2.0}});
  const PrintedObject& object = test::only(plate);
  ASSERT_EQ(object.body.size(), 2u);
  EXPECT_NEAR(object.body[0].moments.volume_mm3, 2, 1e-12);
  EXPECT_NEAR(object.body[1].moments.volume_mm3, 3, 1e-12);
  EXPECT_NEAR(mass_of(object.body).mass_g, 2e-3 + 6e-3, 1e-12);
}

TEST(GcodeMachine, FlowAndVolumetricExtrusionCount) {
  EXPECT_NEAR(mass_after_start("M221 S50\nG1 X10 E2\n").mass_g, 1e-3, 1e-12);
  const auto volumetric = read_program(plain_start() + "M200 D1.75\nG1 X10 E2\n", {{1.75}, {1.0}});
  EXPECT_NEAR(mass_of_only(volumetric).mass_g, 2e-3, 1e-12);
  const auto ended = read_program(plain_start() + "M200 D1.75\nM200 D0\nG1 X10 E2\n", {{1.75}, {1.0}});
  EXPECT_NEAR(mass_of_only(ended).mass_g, 2e-3 * pi / 4 * 1.75 * 1.75, 1e-12);
}

TEST(GcodeMachine, AnArcsCentroidIsThatOfTheArcAndNotOfItsChord) {
  const BodyMass half = mass_after_start("G1 X10 Y0\nG3 X-10 Y0 I-10 J0 E4\n");
  EXPECT_NEAR(half.mass_g, 4e-3, 1e-12);
  EXPECT_NEAR(norm(half.com_mm - Vec3{0, 20 / pi, 0.1}), 0, 1e-9);
  const BodyMass clockwise = mass_after_start("G1 X10 Y0\nG2 X-10 Y0 I-10 J0 E4\n");
  EXPECT_NEAR(norm(clockwise.com_mm - Vec3{0, -20 / pi, 0.1}), 0, 1e-9);
  const BodyMass whole = mass_after_start("G1 X10 Y0\nG3 X10 Y0 I-10 J0 E4\n");
  EXPECT_NEAR(norm(whole.com_mm - Vec3{0, 0, 0.1}), 0, 1e-9);
}

TEST(GcodeMachine, ARadiusGivesTheSameArcAsItsCentre) {
  const std::string at = "G1 X10 Y0\n";
  expect_alike(mass_after_start(at + "G3 X0 Y10 R10 E1\n"), mass_after_start(at + "G3 X0 Y10 I-10 E1\n"));
  expect_alike(mass_after_start(at + "G2 X0 Y10 R10 E1\n"), mass_after_start(at + "G2 X0 Y10 J10 E1\n"));
  expect_alike(mass_after_start(at + "G3 X0 Y10 R-10 E1\n"), mass_after_start(at + "G3 X0 Y10 J10 E1\n"));
}

TEST(GcodeMachine, AnArcIsTheLimitOfFineChords) {
  const int chords = 4000;
  std::string fine = "G1 X10 Y0\n";
  for (int i = 1; i <= chords; ++i) {
    const double angle = 4.0 * i / chords;
    char line[100];
    std::snprintf(line, sizeof line, "G1 X%.12f Y%.12f Z%.12f E%.12f\n", 10 * std::cos(angle), 10 * std::sin(angle),
                  0.2 + 0.1 * i / chords, 2.0 / chords);
    fine += line;
  }
  char arc[100];
  std::snprintf(arc, sizeof arc, "G1 X10 Y0\nG3 X%.12f Y%.12f Z0.3 I-10 J0 E2\n", 10 * std::cos(4.0),
                10 * std::sin(4.0));
  expect_alike(mass_after_start(std::string(";HEIGHT:0.2\n") + arc), mass_after_start(";HEIGHT:0.2\n" + fine), 1e-5);
}

TEST(GcodeMachine, WhatCannotBeReadIsSaidWithItsLine) {
  for (const char* line : {"G5 X1 Y1 E1", "G3 X5 Y5 E1", "G3 X90 Y0 R3 E1", "G3 X3 Y0 I-10 E1", "G1 X{depth} E1",
                           "G18\nG3 X3 Y3 I1 E1", "G3 X1 Y1 I1 P2 E1"}) {
    const auto plate = read_program(plain_start() + line + "\n");
    ASSERT_FALSE(plate) << line;
    EXPECT_EQ(plate.error().code, ErrorCode::unusable_input);
    EXPECT_NE(plate.error().message.find(line[3] == '\n' ? "line 6: " : "line 5: "), std::string::npos)
        << plate.error().message;
  }
  EXPECT_TRUE(read_program(plain_start() + "G1 X0 Y{depth}\nM117 E5 X\nG1 X5 E1\n"));  // it moves no filament
}

}  // namespace
}  // namespace aplomb
