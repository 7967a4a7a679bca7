#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "aplomb/balance/standing_rows.h"
#include "aplomb/io/read_mesh.h"
#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {
namespace {

/// A row of fixtures/manifest.csv. The hashes are checked by fixtures/check_manifest.cmake.
struct Passport {
  std::string file, sha256, licence, made, triangles, closed, volume_mm3, tip_deg, shows;
};

std::vector<Passport> passports() {
  std::ifstream file(std::filesystem::path(APLOMB_FIXTURES) / "manifest.csv");
  std::vector<Passport> out;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    Passport p;
    std::istringstream row(line);
    for (std::string* field :
         {&p.file, &p.sha256, &p.licence, &p.made, &p.triangles, &p.closed, &p.volume_mm3, &p.tip_deg, &p.shows}) {
      std::getline(row, *field, ',');
    }
    out.push_back(p);
  }
  return out;
}

TriangleMesh fixture(const std::string& file) {
  auto read = read_mesh(std::filesystem::path(APLOMB_FIXTURES) / file);
  EXPECT_TRUE(read) << file;
  return read ? read->objects.front().mesh : TriangleMesh{};
}

bool is_figure(const Passport& p) { return p.file.rfind("broken_", 0) != 0 && p.file.rfind("odd_", 0) != 0; }

void PrintTo(const Passport& p, std::ostream* out) { *out << p.file; }

class Fixture : public testing::TestWithParam<Passport> {};

TEST(Fixtures, hold_at_least_ten_figures) {
  int figures = 0;
  for (const Passport& p : passports()) figures += is_figure(p);
  EXPECT_GE(figures, 10);
}

TEST_P(Fixture, has_a_whole_passport) {
  const Passport& p = GetParam();
  EXPECT_EQ(p.sha256.size(), 64U);
  EXPECT_EQ(p.licence, "AGPL-3.0-or-later");
  EXPECT_FALSE(p.made.empty());
  EXPECT_FALSE(p.shows.empty());
}

TEST_P(Fixture, is_a_solid_exactly_when_its_name_does_not_say_broken) {
  const auto check = check_solid(fixture(GetParam().file));
  ASSERT_TRUE(check);
  EXPECT_EQ(check->defects.none(), GetParam().file.rfind("broken_", 0) != 0) << describe(check->defects);
}

TEST_P(Fixture, figures_are_one_body_of_5_to_60_thousand_triangles_60_to_110_mm_high) {
  if (!is_figure(GetParam())) return;
  const auto check = check_solid(fixture(GetParam().file));
  ASSERT_TRUE(check && check->solid) << describe(check->defects);
  EXPECT_EQ(check->solid->bodies(), 1U);
  EXPECT_EQ(check->solid->voids(), 0U);
  const std::size_t triangles = check->solid->mesh().triangles.size();
  EXPECT_EQ(std::to_string(triangles), GetParam().triangles);
  EXPECT_TRUE(triangles >= 5000 && triangles <= 60000) << triangles;
  EXPECT_EQ(check->solid->box().min.z, 0);
  EXPECT_GE(check->solid->box().max.z, 60);
  EXPECT_LE(check->solid->box().max.z, 110);
}

TEST_P(Fixture, has_the_volume_and_tip_angle_of_its_passport) {
  const Passport& p = GetParam();
  if (p.tip_deg.empty()) return;
  const TriangleMesh mesh = fixture(p.file);
  const Moments body = moments(mesh);
  EXPECT_NEAR(body.volume_mm3, std::stod(p.volume_mm3), 1e-6 * body.volume_mm3);
  const auto support = support_polygon(mesh, {});
  ASSERT_TRUE(support);
  const double t = largest_t(standing_rows(*support, {}, RowKind::nominal), body);
  EXPECT_NEAR(std::atan(t) * 180 / std::numbers::pi, std::stod(p.tip_deg), 0.0051);
}

std::string test_name(const testing::TestParamInfo<Passport>& info) {
  return std::filesystem::path(info.param.file).stem().string();
}

INSTANTIATE_TEST_SUITE_P(Each, Fixture, testing::ValuesIn(passports()), test_name);

}  // namespace
}  // namespace aplomb
