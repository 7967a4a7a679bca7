#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "aplomb/io/read_mesh.h"
#include "aplomb/mesh/tet_mesh.h"
#include "cli/command_line.h"
#include "support/elephant.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

/// A column of many triangles that leans too far for any void.
TriangleMesh leaning_column() {
  std::vector<Vec2> profile{{0, 0}};
  for (int ring = 0; ring <= 40; ++ring) profile.push_back({8, 1.5 * ring});
  profile.push_back({0, 60});
  TriangleMesh column = test::lathe(profile, 48);
  for (Vec3& v : column.vertices) v.x += 0.35 * v.z;
  return column;
}

class DeformingCommand : public CommandLine {
 protected:
  /// The report of `aplomb stand` with these flags on the leaning column.
  nlohmann::json report(const std::string& flags, int exit_code) {
    const std::string model = write("column.stl", leaning_column());
    EXPECT_EQ(run("stand " + model + " -o " + path("out.stl") + " --report " + path("r.json") + " " + flags), exit_code)
        << text_of("stderr");
    return nlohmann::json::parse(text_of("r.json"));
  }
};

TEST_F(DeformingCommand, BendsOnlyAsFarAsCarvingFallsShort) {
  EXPECT_EQ(report("--tip 6deg --best-effort", 3).contains("deformation"), false);
  const auto r = report("--tip 6deg --deform auto --deform-limit 20%", 0);
  EXPECT_EQ(r.at("outcome"), "stands");
  EXPECT_GE(r.at("after").at("tip_deg").get<double>(), 6);
  EXPECT_LT(r.at("after").at("tip_deg").get<double>(), 6.2);
  EXPECT_EQ(r.at("mesh").at("outer_unchanged"), false);
  EXPECT_EQ(r.at("mesh").at("self_intersections"), 0);
  const auto d = r.at("deformation");
  EXPECT_EQ(d.at("outcome"), "reached");
  EXPECT_LE(d.at("mean_mm").get<double>(), 12);
  EXPECT_GT(d.at("mean_mm").get<double>(), 0.1);
  EXPECT_GE(d.at("max_mm").get<double>(), d.at("mean_mm").get<double>());
  EXPECT_EQ(run("check " + path("out.stl") + " --tip 6deg"), 0) << text_of("stdout");
}

TEST_F(DeformingCommand, StopsAtTheLimitAndSaysSo) {
  const auto r = report("--tip 30deg --deform auto --deform-limit 1% --trim-base 0 --best-effort", 3);
  const auto d = r.at("deformation");
  EXPECT_EQ(d.at("outcome"), "limit");
  EXPECT_NEAR(d.at("mean_mm").get<double>(), 0.6, 0.01);
  EXPECT_EQ(d.at("trim_mm"), 0);
  EXPECT_NE(text_of("stderr").find("all that the limit allows"), std::string::npos) << text_of("stderr");
}

TEST_F(DeformingCommand, CarvesNothingWhenItIsOnlyToDeform) {
  const auto r = report("--tip 6deg --deform only --deform-limit 30%", 0);
  EXPECT_FALSE(r.contains("carving"));
  EXPECT_EQ(r.at("mesh").at("voids"), 0);
  EXPECT_GE(r.at("after").at("tip_deg").get<double>(), 6);
}

TEST_F(DeformingCommand, MovesAHandleThoughItStandsAlready) {
  const std::string flags = "--handle 17.5,0,50,6:to=12,0,50 --tip 1deg --deform-limit 30%";
  const auto r = report("--contact-height 1mm --deform auto " + flags, 0);
  EXPECT_EQ(r.at("outcome"), "stands");
  EXPECT_LT(r.at("deformation").at("handle_short_mm").get<double>(), 0.5);
  EXPECT_GT(r.at("deformation").at("max_mm").get<double>(), 5);
  EXPECT_GE(r.at("after").at("tip_deg").get<double>(), 1);
}

TEST_F(DeformingCommand, DrawsItBeforeAndAfter) {
  report("--tip 6deg --deform auto --deform-limit 20% --picture " + path("p.png"), 0);
  const std::string png = text_of("p.png");
  ASSERT_GT(png.size(), 20'000u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\x07\x08\0\0\x02\x94", 8));  // 1800 x 660
  EXPECT_EQ(run("check " + path("out.stl") + " --picture " + path("no/such/p.png")), 2);
}

TEST_F(DeformingCommand, SaysWhatIsWrongWithAHandle) {
  const std::string stand = "stand " + write("column.stl", leaning_column()) + " -o " + path("out.stl") + " ";
  const auto error_of = [&](const std::string& flags) {
    EXPECT_EQ(run(stand + flags), 1) << flags;
    return text_of("stderr");
  };
  EXPECT_NE(error_of("--handle 0,0,5:to=1,0,5").find("deform is never, but a handle moves the outside"),
            std::string::npos);
  EXPECT_NE(error_of("--deform auto --handle 0,0,5").find("X,Y,Z[,R]:lock or"), std::string::npos);
  EXPECT_NE(error_of("--deform auto --handle 0,0,5:go=1").find("'go=1' is no change"), std::string::npos);
  EXPECT_NE(error_of("--deform auto --handle 0,0,5:turn=1").find("turn=X,Y,Z in degrees"), std::string::npos);
  EXPECT_NE(error_of("--deform auto --handle 0,0,5:scale=9").find("must lie in [0.2, 5]"), std::string::npos);
  EXPECT_NE(error_of("--deform auto --handle 0,0,500,2:to=1,0,5").find("holds nothing of the model"),
            std::string::npos);
}

TEST_F(DeformingCommand, TrimsARoundedBaseInsteadOfBending) {
  const std::string egg = write(
      "egg.stl", transformed(test::sphere({0, 0, 0}, 10, 5), {{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 3}}}}, {0, 0, 30}}));
  EXPECT_EQ(run("stand " + egg + " --tip 5deg --deform auto --trim-base 3mm -o " + path("out.stl") + " --report " +
                path("r.json")),
            0)
      << text_of("stderr");
  const auto d = nlohmann::json::parse(text_of("r.json")).at("deformation");
  EXPECT_EQ(d.at("outcome"), "trimmed");
  EXPECT_GT(d.at("trim_mm").get<double>(), 0);
  EXPECT_LE(d.at("trim_mm").get<double>(), 3);
  EXPECT_EQ(d.at("mean_mm"), 0);
  EXPECT_GE(d.at("trims").size(), 4u);
}

/// What a part of the surface encloses, its rim closed by a fan: `mesh` has the vertices of `rest`, moved.
double part_volume_mm3(const TriangleMesh& rest, const TriangleMesh& mesh, bool (*is_part)(Vec3)) {
  std::vector<Triangle> part;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> rim;  // edges that only one of its triangles has
  for (const Triangle& t : rest.triangles) {
    if (!is_part(rest.vertices[t[0]]) || !is_part(rest.vertices[t[1]]) || !is_part(rest.vertices[t[2]])) continue;
    part.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) ++rim[std::minmax(t[k], t[(k + 1) % 3])];
  }
  std::erase_if(rim, [](const auto& edge) { return edge.second != 1; });
  Vec3 middle;
  for (const auto& [edge, count] : rim)
    middle += 0.5 / static_cast<double>(rim.size()) * (mesh.vertices[edge.first] + mesh.vertices[edge.second]);
  double volume = 0;
  for (const auto& [a, b, c] : part)
    volume += signed_volume(middle, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  return volume;
}

TEST_F(DeformingCommand, AnElephantOnSmallFeetNeitherFoldsNorSinksNorSwellsAndSaysWhatItLacks) {
  write("elephant.stl", test::elephant_on_small_feet(0.35));
  const TriangleMesh before = read_mesh(fs::path(path("elephant.stl")))->objects.front().mesh;
  EXPECT_EQ(
      run("stand " + path("elephant.stl") + " --tip 20deg --deform auto --trim-base 0 --voxel 0.8mm --best-effort -o " +
          path("out.3mf") + " --report " + path("r.json")),
      3);
  EXPECT_NE(text_of("stderr").find("all that the limit allows"), std::string::npos) << text_of("stderr");
  EXPECT_NE(text_of("stderr").find("--deform-limit"), std::string::npos) << text_of("stderr");
  const auto report = nlohmann::json::parse(text_of("r.json"));
  EXPECT_EQ(report.at("outcome"), "best_effort");
  EXPECT_EQ(report.at("deformation").at("outcome"), "limit");
  EXPECT_LT(report.at("deformation").at("max_turn_deg").get<double>(), 45);
  const TriangleMesh after = read_mesh(fs::path(path("out.3mf")))->objects.front().mesh;
  ASSERT_GT(after.vertices.size(), before.vertices.size());  // the outside first, then the void
  for (const Vec3& v : after.vertices) EXPECT_GE(v.z, 0);
  for (const auto is_part : {test::is_trunk, test::is_left_ear, test::is_right_ear}) {
    const double was_mm3 = part_volume_mm3(before, before, is_part);
    EXPECT_GT(was_mm3, 1000);
    EXPECT_NEAR(part_volume_mm3(before, after, is_part) / was_mm3, 1, 0.03);
  }
}

TEST_F(DeformingCommand, RefusesLimitsThatMakeNoSense) {
  const std::string model = write("column.stl", leaning_column());
  EXPECT_EQ(run("stand " + model + " -o " + path("out.stl") + " --deform-limit 0%"), 1);
  EXPECT_EQ(run("stand " + model + " -o " + path("out.stl") + " --trim-base much"), 1);
  EXPECT_EQ(run("stand " + model + " -o " + path("out.stl") + " --keep 1,2,3"), 1);
  EXPECT_EQ(run("stand " + model + " -o " + path("out.stl") + " --deform perhaps"), 1);
}

}  // namespace
}  // namespace aplomb
