#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "aplomb/io/read_mesh.h"
#include "aplomb/printability/escape.h"
#include "aplomb/printability/walls.h"
#include "support/solids.h"

namespace aplomb {
namespace {

std::vector<std::string> figures() {
  std::ifstream manifest(std::filesystem::path(APLOMB_FIXTURES) / "manifest.csv");
  std::vector<std::string> names;
  std::string line;
  for (std::getline(manifest, line); std::getline(manifest, line);)
    if (line.rfind("broken_", 0) != 0 && line.rfind("odd_", 0) != 0) names.push_back(line.substr(0, line.find('.')));
  return names;
}

PrintedSolid printed(const std::string& name) {
  const auto file = read_mesh(std::filesystem::path(APLOMB_FIXTURES) / (name + ".stl"));
  return printed_solid(test::solid_of(file->objects.front().mesh));
}

class SoundFigure : public testing::TestWithParam<std::string> {};

TEST_P(SoundFigure, has_no_cavity_for_any_process) {
  const PrintedSolid solid = printed(GetParam());
  for (const Process process : {Process::sla, Process::binder})
    EXPECT_TRUE(find_cavities(solid, Rules(process))->empty());
}

TEST_P(SoundFigure, is_thin_nowhere_but_where_it_ends_in_a_sharp_hem) {
  if (GetParam() == "bust") return;  // its drapery ends in an edge of less than 20 degrees: see below
  const PrintedSolid solid = printed(GetParam());
  for (const Process process : {Process::fdm, Process::sla, Process::powder}) {
    const Rules rules(process);
    const auto thinnest = wall_thin(solid, rules);
    ASSERT_FALSE(thinnest->empty());
    EXPECT_GE(thinnest->front().measured, *rules.limits("wall.thin")->warn);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SoundFigure, testing::ValuesIn(figures()), [](const auto& test) { return test.param; });

TEST(ThinFigure, the_hem_of_the_bust_is_found) {
  const auto thin = wall_thin(printed("bust"), Rules(Process::fdm));
  ASSERT_GE(thin->size(), 2U);
  EXPECT_LT(thin->front().measured, 0.2);
}

}  // namespace
}  // namespace aplomb
