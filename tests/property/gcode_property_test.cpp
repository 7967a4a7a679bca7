#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "support/gcode_files.h"

namespace aplomb {
namespace {

using test::mass_of_only;
using test::plain_filament;
using test::read_program;

struct Move {
  Vec3 to_mm;
  double feed_mm = 0;
};

/// Coordinates in thousandths, as slicers write them.
std::vector<Move> random_moves(int least_feed_um = -500) {
  std::vector<Move> moves;
  const auto count = *rc::gen::inRange(1, 20);
  for (int i = 0; i < count; ++i)
    moves.push_back(
        {{*rc::gen::inRange(-9000, 9000) / 1e3, *rc::gen::inRange(-9000, 9000) / 1e3, 0.2 * *rc::gen::inRange(1, 3)},
         *rc::gen::inRange(least_feed_um, 2000) / 1e3});
  moves.push_back({{10, 10, 0.2}, 3});  // something is laid down
  return moves;
}

std::string line(const char* form, double x, double y, double z, double e) {
  char text[120];
  std::snprintf(text, sizeof text, form, x, y, z, e);
  return text;
}

std::string program_of(const std::vector<Move>& moves, Vec3 shift = {}, int pieces = 1, bool is_absolute = false) {
  std::string program = is_absolute ? ";HEIGHT:0.2\nG90\nM82\nG92 E0\n" : ";HEIGHT:0.2\nG90\nM83\n";
  Vec3 at;
  program += line("G1 X%.9f Y%.9f Z%.9f F%.0f\n", shift.x, shift.y, 0, 1000);
  double e = 0;
  for (const Move& move : moves) {
    for (int i = 1; i <= pieces; ++i) {
      const Vec3 to = at + (static_cast<double>(i) / pieces) * (move.to_mm - at) + shift;
      e = (is_absolute ? e : 0) + move.feed_mm / pieces;
      program += line("G1 X%.9f Y%.9f Z%.9f E%.9f\n", to.x, to.y, to.z, e);
    }
    at = move.to_mm;
  }
  return program;
}

BodyMass mass_of_program(const std::string& program) { return mass_of_only(read_program(program, plain_filament)); }

void assert_alike(const BodyMass& a, const BodyMass& b, Vec3 shift = {}) {
  RC_ASSERT(std::abs(a.mass_g - b.mass_g) < 1e-9);
  RC_ASSERT(norm(a.com_mm + shift - b.com_mm) < 1e-5);
}

TEST(GcodeProperty, TranslationOfTheMovesTranslatesTheCentreOfMass) {
  EXPECT_TRUE(rc::check([] {
    const auto moves = random_moves();
    const Vec3 shift{*rc::gen::inRange(-200, 200) / 1e1, *rc::gen::inRange(-200, 200) / 1e1, 0};
    assert_alike(mass_of_program(program_of(moves)), mass_of_program(program_of(moves, shift)), shift);
  }));
}

TEST(GcodeProperty, AbsoluteExtrusionIsRelativeExtrusionSummedUp) {
  EXPECT_TRUE(rc::check([] {
    const auto moves = random_moves();
    assert_alike(mass_of_program(program_of(moves)), mass_of_program(program_of(moves, {}, 1, true)));
  }));
}

TEST(GcodeProperty, CuttingMovesInPiecesChangesNothing) {
  EXPECT_TRUE(rc::check([] {
    const auto moves = random_moves(0);  // those that draw back, and pay for it, are others when they are cut
    const int pieces = *rc::gen::inRange(2, 6);
    assert_alike(mass_of_program(program_of(moves)), mass_of_program(program_of(moves, {}, pieces)));
  }));
}

TEST(GcodeProperty, ATurnOfTheArcsTurnsTheCentreOfMass) {
  EXPECT_TRUE(rc::check([] {
    const double radius = *rc::gen::inRange(100, 9000) / 1e3, sweep = *rc::gen::inRange(-620, 620) / 1e2;
    const double turn = *rc::gen::inRange(0, 628) / 1e2;
    RC_PRE(std::abs(sweep) > 0.05);
    const auto arc = [&](double from) {
      const double x = radius * std::cos(from), y = radius * std::sin(from);
      std::string program = "G90\nM83\n" + line("G1 X%.12f Y%.12f Z%.1f F%.0f\n", x, y, 0.2, 1000);
      program += line(sweep > 0 ? "G3 X%.12f Y%.12f I%.12f J%.12f E1\n" : "G2 X%.12f Y%.12f I%.12f J%.12f E1\n",
                      radius * std::cos(from + sweep), radius * std::sin(from + sweep), -x, -y);
      return mass_of_program(program).com_mm;
    };
    const Vec3 plain = arc(0), turned = arc(turn);
    const Vec3 expected{plain.x * std::cos(turn) - plain.y * std::sin(turn),
                        plain.x * std::sin(turn) + plain.y * std::cos(turn), plain.z};
    RC_ASSERT(norm(turned - expected) < 1e-9);
  }));
}

}  // namespace
}  // namespace aplomb
