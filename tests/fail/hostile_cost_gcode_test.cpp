// G-code made to cost more than it is: every program ends in under 10 s, in memory that does not grow with it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fail/expect_within.h"
#include "support/gcode_files.h"

namespace aplomb::test {
namespace {

/// Reads a program in a process of its own, which must end in time and in the constant memory that is promised.
void expect_cheap_program(const std::string& program) {
  expect_within(cost_of([&] { read_program(program); }), 100 * megabyte, "a program");
}

TEST(HostileCost, ARoundFootOfAHundredThousandBeadsCostsNoMoreThanItsLength) {
  std::string program = plain_start();
  const int beads = is_sanitized() ? 5'000 : 200'000;
  for (int i = 0; i < beads; ++i) {
    const double angle = 2 * std::numbers::pi * i / beads;
    program += "G1 X" + std::to_string(1e4 * std::cos(angle)) + " Y" + std::to_string(1e4 * std::sin(angle)) + " E1\n";
  }
  expect_cheap_program(program);
  expect_cheap_program(";TYPE:Skirt\n" + program + ";TYPE:Perimeter\nG1 X0 Y0 E1\nG1 X5 E1\nG1 Y5 E1\n");
}

TEST(HostileCost, AMegabyteOfArcsCostsNoMoreThanItsLines) {
  const int count = is_sanitized() ? 3'000 : 100'000;
  std::string growing = plain_start(), wandering = plain_start();
  for (int i = 0; i < count; ++i) {
    growing += "G3I" + std::to_string(1 + 1e-4 * i) + "E1\n";
    wandering += "G3X" + std::to_string(i % 997) + "R" + std::to_string(1e3 + i % 7) + "E1\n";
  }
  for (const std::string& arcs :
       {plain_start() + repeated("G3I9E1\n", static_cast<std::size_t>(count)), growing, wandering}) {
    expect_cheap_program(arcs);
    expect_cheap_program(";TYPE:Skirt\n" + arcs + ";TYPE:Perimeter\nG1 X0 Y0 E1\nG1 X5 E1\nG1 Y5 E1\n");
  }
}

/// Loops of a brim, each of which touches only the one before it, from far to near, and objects beside the first.
std::string chain(int loops, int objects) {
  std::string program = plain_start() + ";TYPE:Skirt\n";
  for (int i = loops; i-- > 0;) program += "G1X" + std::to_string(5.5 + 0.5 * i) + "Y5\nG1Y6E.02\n";
  for (int i = 0; i < objects; ++i)
    program += "; printing object " + std::to_string(i) + "\n;TYPE:Perimeter\nG1X0Y0\nG1X5E1\nG1Y5E1\n";
  return program;
}

TEST(HostileCost, BrimsThatChainFromFarToNearCostNoMoreThanOthers) {
  // The most that is told apart: a million pairs.
  expect_cheap_program(chain(is_sanitized() ? 300 : 4'000, is_sanitized() ? 20 : 250));
  expect_cheap_program(chain(100, is_sanitized() ? 100 : 9'999));
  const std::string program = chain(4'096, 10'000);
  expect_cheap_program(program);
  const auto plate = read_program(program), chained = read_program(chain(100, 2));
  ASSERT_TRUE(plate && chained);
  EXPECT_NE(plate->notes.back().find("brims are left out"), std::string::npos) << plate->notes.back();
  const auto just_under = read_program(chain(4'000, 250)), just_over = read_program(chain(4'000, 251));
  ASSERT_TRUE(just_under && just_over);
  EXPECT_TRUE(just_under->objects[249].with_brim.has_value());
  EXPECT_FALSE(just_over->objects[250].with_brim.has_value());
  ASSERT_TRUE(chained->objects[1].with_brim.has_value());
  EXPECT_GT(chained->objects[1].with_brim->area_mm2(), chained->objects[1].contact.area_mm2() + 100);
}

TEST(HostileCost, ThousandsOfObjectsWithAllTheyCanHoldStayWithinTheirBound) {
  std::string program = plain_start();
  for (int i = 0; i < (is_sanitized() ? 50 : 9'999); ++i) {
    program += "; printing object " + std::to_string(i) + std::string(400, 'n') + "\n";
    for (const char* feature : {"Perimeter", "Skirt", "Support material", "Wipe tower"})
      for (int tool = 0; tool < 9; ++tool)
        program += ";TYPE:" + std::string(feature) + "\nT" + std::to_string(tool) + "\nG1X" +
                   std::to_string(100 * std::cos(0.7 * tool)) + "Y" + std::to_string(100 * std::sin(0.7 * tool)) +
                   "E1\n";
  }
  expect_cheap_program(program);
}

TEST(HostileCost, ThousandsOfObjectsBesideThousandsOfBrimsCostNoMoreThanTheirProduct) {
  std::string program = plain_start() + ";TYPE:Skirt\n";
  const int count = is_sanitized() ? 300 : 4'000;
  for (int i = 0; i < count; ++i) {
    const std::string x = "G1 X" + std::to_string(10 * i);
    program += x + " Y0\n" + x + ".5 Y1 E0.1\n";
  }
  for (int i = 0; i < count; ++i) {
    program += "; printing object " + std::to_string(i) + "\n";
    for (int tool = 0; tool < 20; ++tool)
      program += ";TYPE:Perimeter\nT" + std::to_string(tool) + "\nG1 X" + std::to_string(tool % 7) + " Y" +
                 std::to_string(i % 11) + " E1\n";
  }
  expect_cheap_program(program);
}

TEST(HostileCost, LabelsOfAMegabyteEachAreNotKept) {
  std::string program = plain_start();
  for (int i = 0; i < (is_sanitized() ? 10 : 300); ++i)
    program += "; printing object " + std::to_string(i) + std::string(900'000, 'n') + "\nG1 X" + std::to_string(i % 7) +
               " E1\n";
  expect_cheap_program(program);
}

}  // namespace
}  // namespace aplomb::test
