#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "aplomb/balance/resting.h"
#include "aplomb/io/read_mesh.h"

namespace aplomb {
namespace {

std::filesystem::path models_folder() {
  const char* named = std::getenv("APLOMB_MODELS");
  return (named ? std::filesystem::path(named) : std::filesystem::path(APLOMB_MODELS)) / "clean";
}

constexpr Vec3 y{0, 1, 0}, z{0, 0, 1};

struct Figure {
  const char* file;
  Vec3 up;
};

constexpr Figure figures[] = {{"armadillo.obj", y},    {"armadillo_15k.obj", y}, {"bunny_pmp.off", y},
                              {"cactus.off", z},       {"camel_b.obj", y},       {"cartoon-elephant.obj", y},
                              {"cheburashka.obj", y},  {"cow_low.obj", y},       {"elephant_igl.obj", y},
                              {"elephant_pmp.off", y}, {"homer.off", y},         {"horse.ply", z},
                              {"knight_low.off", y},   {"koala.obj", y},         {"lucy_vtk.ply", z},
                              {"nefertiti.obj", z},    {"spot.obj", y},          {"springer.obj", y}};

class RestingHintOnModels : public testing::TestWithParam<Figure> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(models_folder())) GTEST_SKIP() << "no models in " << models_folder();
    mesh_ = read_mesh(models_folder() / GetParam().file).value().objects.front().mesh;
    body_ = moments(mesh_);
    if (body_.volume_mm3 < 0) body_ = -1.0 * body_;  // one is inside out
  }
  TriangleMesh mesh_;
  Moments body_;
};

TEST_P(RestingHintOnModels, IsSilentWhenTheFigureIsUpright) {
  EXPECT_FALSE(resting_hint(mesh_, body_, {.up = GetParam().up}));
}

TEST_P(RestingHintOnModels, NamesTheRightWayUpWhenItLies) {
  const bool stands_square = std::string_view(GetParam().file) != "cheburashka.obj" &&  // topples upright
                             std::string_view(GetParam().file) != "elephant_pmp.off";
  const auto hint = resting_hint(mesh_, body_, {.up = GetParam().up == y ? z : y});
  if (!stands_square) {
    EXPECT_FALSE(hint && hint->up);
    return;
  }
  ASSERT_TRUE(hint && hint->up);
  EXPECT_EQ(*hint->up, GetParam().up);
}

INSTANTIATE_TEST_SUITE_P(Figures, RestingHintOnModels, testing::ValuesIn(figures), [](const auto& figure) {
  std::string name = figure.param.file;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

}  // namespace
}  // namespace aplomb
