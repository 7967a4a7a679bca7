#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "aplomb/deform/reshape.h"
#include "aplomb/pipeline.h"

namespace aplomb {
namespace {

std::filesystem::path models_folder() {
  const char* named = std::getenv("APLOMB_MODELS");
  return (named ? std::filesystem::path(named) : std::filesystem::path(APLOMB_MODELS)) / "clean";
}

/// Its raised foot was foreseen to sink, and then pressed so hard on the ground that the search ended at 3.7 degrees.
TEST(BendModels, AnElephantThatPressesOnTheGroundGetsAsFarAsTheLimitAllows) {
  if (!std::filesystem::exists(models_folder())) GTEST_SKIP() << "no models in " << models_folder();
  InputOptions options;
  options.placement.up = UpAxis::y;
  options.placement.height_mm = 100;
  const auto input = load_solid(models_folder() / "elephant_pmp.off", options);
  ASSERT_TRUE(input) << input.error().message;
  const std::vector<Pose> poses{{.way = StandingPose{.contact_height_mm = 1}}};
  const auto reshaper =
      Reshaper::make(input->solid, poses, RowKind::nominal, {.most_mean_percent = 15, .most_trim_mm = 0, .wall_mm = 2});
  ASSERT_TRUE(reshaper) << reshaper.error().message;
  const auto reshaped = reshaper->reshape(0);
  ASSERT_TRUE(reshaped) << reshaped.error().message;
  EXPECT_EQ(reshaped->bent->cage.outcome, DeformOutcome::limit);
  EXPECT_GT(std::atan(reshaped->bent->cage.t), 4.1 * M_PI / 180);
}

}  // namespace
}  // namespace aplomb
