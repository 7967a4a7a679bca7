#include "aplomb/gcode/verify_print.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/gcode_files.h"

namespace aplomb {
namespace {

using test::plain_filament;
using test::plain_start;
using test::read_program;
using test::square_loop;

constexpr double pi = std::numbers::pi;

/// A square tube of 20 mm, `layers` high.
std::string tube(int layers) {
  std::string program = plain_start() + "; printing object tube\n;TYPE:Perimeter\n";
  for (int k = 1; k <= layers; ++k) program += square_loop(50, 60, 20, 0.2 * k);
  return program + "; stop printing object tube\n";
}

Result<Verification> verified(const std::string& program, const VerifyOptions& options = {}) {
  return read_program(program, plain_filament).and_then([&](PrintedPlate plate) {
    return verify_print(std::move(plate), options);
  });
}

TEST(VerifyPrint, AFootIsTheHullOfItsBeads) {
  const auto plate = read_program(tube(3), plain_filament);
  const PrintedObject& object = test::only(plate);
  const double disc_mm2 = 16 * std::sin(pi / 16) * 0.04;  // of 32 corners, radius 0.2
  EXPECT_NEAR(object.contact.area_mm2(), 20 * 20 + 4 * 20 * 0.2 + disc_mm2, 1e-9);
  EXPECT_NEAR(object.bead_width_mm, 0.4, 1e-12);
  EXPECT_NEAR(object.contact_layer_mm, 0.2, 1e-12);
  EXPECT_NEAR(object.contact.height_mm, 0.6, 1e-12);
}

TEST(VerifyPrint, TheTipAngleIsHalfTheFootOverTheHeightOfTheCentreOfMass) {
  const auto v = verified(tube(100));
  ASSERT_TRUE(v) << v.error().message;
  const Stability& s = v->objects[0].stability;
  EXPECT_NEAR(s.com_height_mm, 10, 1e-9);
  EXPECT_NEAR(s.tip_rad, std::atan2(10.2, 10), 1e-9);
  EXPECT_TRUE(v->all_stand());
  EXPECT_FALSE(verified(tube(100), {.required_tip_rad = 46 * pi / 180})->all_stand());
}

TEST(VerifyPrint, ALineCannotStand) {
  const auto v = verified(plain_start() + "G1 X10 E1\nG1 X0 Z0.4 E1\n");
  ASSERT_TRUE(v) << v.error().message;
  EXPECT_FALSE(verified(plain_start() + "G1 X1 E0.02\n", {.required_tip_rad = 89 * pi / 180})->all_stand());
}

TEST(VerifyPrint, ABrimHelpsAndASkirtDoesNot) {
  const auto with_loops = [](double inner_mm, int count) {
    std::string loops = plain_start() + ";TYPE:Skirt/Brim\n";
    for (int i = count - 1; i >= 0; --i) loops += square_loop(50, 60, inner_mm + 0.8 * i);
    return read_program(loops + tube(50), plain_filament);
  };
  const auto brim = with_loops(20.8, 8), skirt = with_loops(26.4, 3);
  ASSERT_TRUE(test::only(brim).with_brim);
  EXPECT_NEAR(test::only(brim).with_brim->width_mm(), 26.8, 1e-9);
  EXPECT_NEAR(test::only(brim).contact.width_mm(), 20.4, 1e-9);
  EXPECT_FALSE(test::only(skirt).with_brim);
}

ExpectedPrint promised_tube() {
  ExpectedPrint promised{
      .mass_g = 0.64, .density_g_per_cm3 = 1, .com_mm = {1, 2, 10}, .com_height_mm = 10, .tip_rad = 0.7};
  promised.box_mm = Box3{{-9.2, -8.2, 0}, {11.2, 12.2, 20}};
  return promised;
}

TEST(VerifyPrint, APromiseHoldsWhereverThePrintLies) {
  VerifyOptions options{.expected = promised_tube()};
  const auto v = verified(tube(100), options);
  ASSERT_TRUE(v) << v.error().message;
  const PrintError& error = *v->objects[0].error;
  EXPECT_NEAR(error.mass_ratio, 0, 1e-9);
  EXPECT_NEAR(norm(error.com_mm), 0, 1e-9);
  EXPECT_TRUE(v->all_as_told());
}

TEST(VerifyPrint, ABrokenPromiseIsTold) {
  ExpectedPrint heavier = promised_tube(), higher = promised_tube(), larger = promised_tube();
  heavier.mass_g *= 1.06;
  higher.com_height_mm += 0.6;
  larger.box_mm->max.x += 5;
  for (const ExpectedPrint& wrong : {heavier, higher, larger}) {
    const auto v = verified(tube(100), {.expected = wrong});
    ASSERT_TRUE(v) << v.error().message;
    EXPECT_FALSE(v->all_as_told());
    EXPECT_TRUE(v->all_stand());
  }
  EXPECT_TRUE(verified(tube(100), {.expected = heavier, .most_mass_error_ratio = 0.1})->all_as_told());
}

TEST(VerifyPrint, WhereTheProgramKnowsNoDensityVolumesAreCompared) {
  ExpectedPrint abs = promised_tube();
  abs.density_g_per_cm3 = 1.04;
  abs.mass_g *= 1.04;
  auto plate = read_program(tube(100), {{1.1283791670955126}, {}});
  ASSERT_TRUE(plate) << plate.error().message;
  EXPECT_NEAR(verify_print(std::move(*plate), {.expected = abs})->objects[0].error->mass_ratio, 0, 1e-9);
}

TEST(VerifyPrint, OneObjectCanBeChosen) {
  const std::string two = plain_start() + "; printing object a id:0\n" + square_loop(10, 10, 9) +
                          "; printing object b id:1\n" + square_loop(50, 50, 9);
  EXPECT_EQ(verified(two)->objects.size(), 2u);
  for (const char* name : {"b id:1", "b", "2"}) {
    const auto v = verified(two, {.object = name});
    ASSERT_TRUE(v) << v.error().message;
    ASSERT_EQ(v->objects.size(), 1u);
    EXPECT_EQ(v->objects[0].printed.name, "b id:1");
  }
  const auto none = verified(two, {.object = "c"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "object is 'c' but must be one of: 1 a id:0, 2 b id:1");
}

TEST(VerifyPrint, OptionsOutOfRangeAreNamed) {
  EXPECT_EQ(find_problem(VerifyOptions{.required_tip_rad = 2}).rfind("required_tip_rad", 0), 0u);
  EXPECT_EQ(find_problem(VerifyOptions{.most_mass_error_ratio = 0}).rfind("most_mass_error_ratio", 0), 0u);
  EXPECT_EQ(find_problem(VerifyOptions{.most_com_error_mm = -1}).rfind("most_com_error_mm", 0), 0u);
  EXPECT_EQ(find_problem(GcodeOptions{.diameters_mm = {1.75, 0}}).rfind("diameters_mm", 0), 0u);
  EXPECT_EQ(find_problem(GcodeOptions{.densities_g_per_cm3 = {-1}}).rfind("densities_g_per_cm3", 0), 0u);
  EXPECT_TRUE(find_problem(VerifyOptions{}).empty() && find_problem(GcodeOptions{}).empty());
}

}  // namespace
}  // namespace aplomb
