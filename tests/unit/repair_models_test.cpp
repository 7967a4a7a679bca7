// Real models with every kind of defect; the folder is no part of the tree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "aplomb/io/read_mesh.h"
#include "aplomb/mesh/bodies.h"
#include "aplomb/mesh/repair.h"

namespace aplomb {
namespace {

namespace fs = std::filesystem;

fs::path models() {
  const char* place = std::getenv("APLOMB_MODELS");
  return place ? place : APLOMB_MODELS;
}

std::vector<fs::path> files_in(const char* folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(models() / folder))
    for (const auto& entry : fs::directory_iterator(models() / folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TriangleMesh read(const fs::path& path) { return read_mesh(path).value().objects.at(0).mesh; }

class RepairModels : public testing::TestWithParam<fs::path> {};

TEST_P(RepairModels, ends_in_a_solid_where_the_model_was_or_in_a_reason_and_its_remedy) {
  const TriangleMesh mesh = read(GetParam());
  const Result<Repaired> result = repair(mesh);
  if (!result) {
    EXPECT_EQ(result.error().code, ErrorCode::unusable_input);
    EXPECT_NE(result.error().message.find("--repair force"), std::string::npos) << result.error().message;
    return;
  }
  const auto& [solid, report, prints] = *result;
  EXPECT_TRUE(check_solid(solid.mesh()).value().defects.none());
  EXPECT_EQ(prints.of_triangle, number_prints(solid.mesh()).value().of_triangle);
  EXPECT_GT(report.volume_after_mm3, 0);
  EXPECT_EQ(report.outer_unchanged, report.method == RepairMethod::none);
  EXPECT_EQ(report.found.none(), report.method == RepairMethod::none);
  const Box3 box = bounding_box(mesh);
  EXPECT_LT(norm(solid.box().min - box.min), 0.015 * box.diagonal());
  EXPECT_LT(norm(solid.box().max - box.max), 0.015 * box.diagonal());
  EXPECT_LT(report.max_deviation_mm, 0.015 * box.diagonal());
}

std::string name_of_file(const testing::TestParamInfo<fs::path>& info) {
  std::string name = info.param.filename().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Clean, RepairModels, testing::ValuesIn(files_in("clean")), name_of_file);
INSTANTIATE_TEST_SUITE_P(Dirty, RepairModels, testing::ValuesIn(files_in("dirty")), name_of_file);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RepairModels);

TEST(RepairSpot, what_was_done_to_the_model_is_undone_to_its_volume) {
  if (files_in("dirty").empty()) GTEST_SKIP() << "no real models beside the tree";
  const double volume = repair(read(models() / "clean" / "spot.obj"))->report.volume_after_mm3;
  for (const char* damage : {"flip30", "insideout", "innershell", "tjunction_zeroarea", "holes"}) {
    const Repaired result = repair(read(models() / "dirty" / ("synth_spot_" + std::string(damage) + ".obj"))).value();
    EXPECT_NEAR(result.report.volume_after_mm3, volume, 1e-3 * volume) << damage;
    EXPECT_NE(result.report.method, RepairMethod::remeshed) << damage;
  }
}

}  // namespace
}  // namespace aplomb
