#include "aplomb/deform/trim_choice.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb::test {
namespace {

TEST(TrimGains, OfABallAreThoseOfItsCircleOfContact) {
  const double r = 20;
  const SolidMesh ball = solid_of(sphere({0, 0, r}, r, 6));
  StandingPose pose;
  pose.contact_height_mm = 0.05;
  const double thick_wall = 19;  // next to nothing may be carved
  const std::array trims{0.0, 1.0, 2.0, 4.0};
  const auto gains = trim_gains(ball, pose, RowKind::nominal, thick_wall, trims);
  ASSERT_TRUE(gains) << gains.error().message;
  ASSERT_EQ(gains->size(), 4u);
  for (const TrimGain& gain : *gains) {
    if (gain.trim_mm == 0) continue;
    const double top = gain.trim_mm + pose.contact_height_mm;
    const double contact = std::sqrt(2 * r * top - top * top);  // the cut, and what is as low as that touches
    const double h = gain.trim_mm, cap = M_PI * h * h * (3 * r - h) / 3,
                 below = M_PI / 4 * h * h * (2 * r - h) * (2 * r - h);
    const double volume = 4.0 / 3 * M_PI * r * r * r - cap;
    const double height = below / volume + r - h;  // of the centre of mass above the cut
    EXPECT_NEAR(gain.t, contact / height, 0.02 * contact / height) << gain.trim_mm;
  }
}

TEST(TrimGains, ComeBackWithoutTrimsThatLeaveNothing) {
  const SolidMesh prism = solid_of(box({0, 0, 0}, {10, 10, 30}));
  const auto gains = trim_gains(prism, {}, RowKind::nominal, 2, std::array{0.0, 1.0, 40.0});
  ASSERT_TRUE(gains);
  EXPECT_EQ(gains->size(), 2u);
}

TEST(ChosenTrim, IsTheSmallestThatServes) {
  const std::array<TrimGain, 4> gains{{{0, 0.1}, {0.5, 0.15}, {1, 0.2}, {2, 0.3}}};
  EXPECT_EQ(chosen_trim_mm(gains, 0.05), 0);
  EXPECT_EQ(chosen_trim_mm(gains, 0.18), 1);
  EXPECT_EQ(chosen_trim_mm(gains, 0.5), 2) << "none serves: the one that gains most";
}

TEST(ChosenTrim, IsNoneThatGainsNextToNothing) {
  EXPECT_EQ(chosen_trim_mm(std::array<TrimGain, 2>{{{0, 0.1}, {2, 0.1005}}}, 0.5), 0);
  EXPECT_EQ(chosen_trim_mm(std::array<TrimGain, 3>{{{0, 0.1}, {1, 0.1999}, {2, 0.2}}}, 0.5), 1) << "1 mm gains as much";
}

}  // namespace
}  // namespace aplomb::test
