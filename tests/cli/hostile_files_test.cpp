// Shapes and sizes that have bitten mesh tools, through the program itself: a valid shell, or one sentence, the exit
// code of its kind and no output.
#include <sys/resource.h>

#include <algorithm>
#include <fstream>

#include "aplomb/io/read_mesh.h"
#include "aplomb/mesh/solid_mesh.h"
#include "cli/command_line.h"
#include "support/cost.h"
#include "support/many_bodies.h"
#include "support/mesh_files.h"
#include "support/zip_files.h"

namespace aplomb {
namespace {

using test::box;

class HostileFiles : public CommandLine {
 protected:
  /// Seconds of CPU of the programs that have ended, and of their children: what others do meanwhile does not count.
  static double children_cpu_s() {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  }
  /// Runs a command, and asks that it ends in time and in a way that a model may end it. \return the exit code.
  int ends(const std::string& command, const std::string& model, const std::string& more = "") {
    constexpr double most_s = 10;
    int code = -1;
    const auto run_once = [&] {
      const double before_s = children_cpu_s();
      code = run(command + " " + model + " -q " + more);
      return children_cpu_s() - before_s;
    };
    EXPECT_LT(test::least_seconds(run_once, most_s), most_s) << command << " " << model;
    EXPECT_TRUE(code == 0 || code == 2 || code == 3 || code == 5 || code == 6)
        << command << " " << model << " ends in " << code << text_of("stderr");
    if (code == 2 || code == 5) expect_one_sentence();
    return code;
  }
  /// The commands that write no mesh.
  void expect_answer_or_reason(const std::string& model) {
    for (const char* command : {"check", "validate", "poses"}) ends(command, model);
  }
  /// Runs `stand`, which ends either with a solid written or with nothing written and its reason; and the others.
  void expect_shell_or_reason(const std::string& model, const std::string& more = "") {
    if (more.empty()) expect_answer_or_reason(model);
    fs::remove(path("out.stl"));
    const int code = ends("stand", model, "--best-effort --tip 1deg " + more + " -o " + path("out.stl"));
    const bool is_written = fs::exists(path("out.stl"));
    EXPECT_EQ(is_written, code == 0 || code == 3 || code == 6) << model << " ends in " << code << text_of("stderr");
    if (!is_written) return expect_one_sentence();
    const auto file = read_mesh(path("out.stl"));
    ASSERT_TRUE(file) << model;
    EXPECT_TRUE(check_solid(file->objects.at(0).mesh)->solid) << model;
  }
  void expect_refused(const std::string& arguments, int code, const std::string& words) {
    fs::remove(path("out.stl"));
    EXPECT_EQ(run(arguments + " -q -o " + path("out.stl")), code) << arguments << text_of("stderr");
    EXPECT_FALSE(fs::exists(path("out.stl"))) << arguments;
    EXPECT_NE(text_of("stderr").find(words), std::string::npos) << text_of("stderr");
    expect_one_sentence();
  }
  void expect_one_sentence() const {
    const std::string said = text_of("stderr");
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_GT(said.size(), 20u) << said;
  }
};

/// A grid of quads over two parameters, u round and v round or not; `at` gives the points.
template <class At>
TriangleMesh surface(std::uint32_t across, std::uint32_t along, bool closes, const At& at) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < along; ++i)
    for (std::uint32_t j = 0; j < across; ++j) mesh.vertices.push_back(at(double(j) / across, double(i) / along));
  const auto index = [&](std::uint32_t i, std::uint32_t j) {
    const bool turned = i == along;  // one-sided: the far end meets the near one turned over
    return (i % along) * across + (turned ? (across - j) % across : j % across);
  };
  const std::uint32_t columns = closes ? across : across - 1;
  for (std::uint32_t i = 0; i < along; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      mesh.triangles.push_back({index(i, j), index(i, j + 1), index(i + 1, j)});
      mesh.triangles.push_back({index(i, j + 1), index(i + 1, j + 1), index(i + 1, j)});
    }
  return mesh;
}

TriangleMesh klein_bottle() {
  return surface(24, 48, true, [](double u, double v) {
    const double a = 2 * M_PI * u, b = 2 * M_PI * v, r = 20 + 8 * (cos(b / 2) * sin(a) - sin(b / 2) * sin(2 * a));
    return Vec3{r * cos(b), r * sin(b), 8 * (sin(b / 2) * sin(a) + cos(b / 2) * sin(2 * a))};
  });
}

TEST_F(HostileFiles, OneSidedSurfacesAndSheetsWithoutThicknessEndInAShellOrAReason) {
  expect_shell_or_reason(write("klein.stl", klein_bottle()));
  const TriangleMesh moebius = surface(8, 60, false, [](double u, double v) {
    const double b = 2 * M_PI * v, s = 10 * (u - 7.0 / 16), r = 20 + s * cos(b / 2);
    return Vec3{r * cos(b), r * sin(b), s * sin(b / 2)};
  });
  expect_shell_or_reason(write("moebius.stl", moebius));
  TriangleMesh sheet{{{0, 0, 0}, {30, 0, 0}, {30, 0, 30}, {0, 0, 30}}, {{0, 1, 2}, {0, 2, 3}}};
  expect_shell_or_reason(write("sheet.stl", sheet));
  expect_shell_or_reason(write("two_sided.stl", joined(sheet, reversed(sheet))));
  expect_shell_or_reason(write("one.stl", TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  expect_shell_or_reason(write("points.stl", TriangleMesh{{{5, 5, 5}}, std::vector<Triangle>(100, {0, 0, 0})}));
}

TEST_F(HostileFiles, ShellsTwiceInsideOutNestedEveryWayOrOpenEndInAShellOrAReason) {
  const TriangleMesh outer = box({0, 0, 0}, {30, 30, 30}), inner = box({10, 10, 10}, {20, 20, 20}),
                     innermost = box({13, 13, 13}, {17, 17, 17});
  for (int turned = 0; turned < 8; ++turned) {
    const auto wound = [turned](const TriangleMesh& mesh, int bit) { return turned & bit ? reversed(mesh) : mesh; };
    expect_shell_or_reason(write("nested.stl", joined(joined(wound(outer, 1), wound(inner, 2)), wound(innermost, 4))));
  }
  expect_shell_or_reason(write("twice.stl", joined(outer, outer)));
  expect_shell_or_reason(write("against.stl", joined(outer, reversed(outer))));
  TriangleMesh open = outer;
  open.triangles.pop_back();
  expect_shell_or_reason(write("open.stl", open));
  open.triangles.resize(6);
  expect_shell_or_reason(write("half.stl", open));
}

TEST_F(HostileFiles, BodiesThatTouchAtAVertexAnEdgeOrAPartOfAFaceEndInAShellOrAReason) {
  const TriangleMesh first = box({0, 0, 0}, {20, 20, 20});
  for (const Vec3 at : {Vec3{20, 20, 20}, Vec3{20, 20, 0}, Vec3{20, 5, 0}, Vec3{10, 10, 10}, Vec3{0, 0, 20}})
    expect_shell_or_reason(write("pair.stl", joined(first, box(at, at + Vec3{20, 20, 20}))));
}

TEST_F(HostileFiles, ManyBodiesApartNestedOrCrossingEndInAShellOrAReason) {
  const std::string apart = write("apart.stl", test::tetrahedra_apart(200'000));  // a million: ManyBodies
  for (const char* command : {"check", "poses", "stand"}) {
    EXPECT_EQ(ends(command, apart, command == std::string("stand") ? "-o " + path("out.stl") : ""), 2);
    EXPECT_NE(text_of("stderr").find("200000 prints"), std::string::npos) << text_of("stderr");
  }
  ends("validate", write("fewer.stl", test::tetrahedra_apart(2'000)));  // it measures every wall
  expect_shell_or_reason(write("nested.stl", test::tetrahedra_nested(50'000)));
  expect_shell_or_reason(write("crossing.stl", test::tetrahedra_crossing(10'000)));
}

TEST_F(HostileFiles, ModelsOfAKilometreOrANanometreAndVoxelsOfEverySizeEndInAShellOrAReason) {
  const std::string large = write("large.stl", test::leaning_prism(3e5, 3e5, 1e6, 3e5)),
                    small = write("small.stl", test::leaning_prism(3e-7, 3e-7, 1e-6, 3e-7));
  expect_shell_or_reason(large);
  expect_shell_or_reason(small);
  expect_refused("stand " + large + " --voxel 0.1mm --tip 1deg", 5, "memory");
  expect_refused("stand " + toppling() + " --voxel 500mm --tip 1deg", 1, "half the wall");
  expect_shell_or_reason(toppling(), "--wall 400mm");
  expect_shell_or_reason(
      write("far.stl", transformed(box({0, 0, 0}, {20, 20, 40}), test::translation({1e9, -1e9, 1e9}))));
}

TEST_F(HostileFiles, FiftyMillionFacetsThatAreNotThereAreRefusedAndTooManyAreOverBudget) {
  const auto claim = [this](const std::string& name, std::uint32_t count, std::uint64_t bytes) {
    std::string head(80, ' ');
    head.append(reinterpret_cast<const char*>(&count), 4);
    std::ofstream(path(name), std::ios::binary) << head;
    fs::resize_file(path(name), bytes);  // sparse: zeros that take no disk
    return path(name);
  };
  expect_refused("stand " + claim("lies.stl", 50'000'000, 1000), 2, "facets");
  expect_refused("stand " + claim("many.stl", 50'000'001, 84 + 50ull * 50'000'001), 5, "triangles");
  expect_refused("stand " + claim("huge.stl", 4'000'000'000u, 84 + 50ull * 4'000'000'000u), 5, "budget");
}

TEST_F(HostileFiles, ScriptsInAProjectAreLeftOutAndThatIsSaid) {
  const std::string model =
      test::model_xml(test::tetrahedron_object(1), "<item objectid=\"1\" transform=\"20 0 0 0 20 0 0 0 20 0 0 0\"/>");
  const std::string script = "; post_process = touch " + path("owned") + "\n";
  std::ofstream(path("project.3mf"), std::ios::binary) << test::package(model, {{"Metadata/Slic3r_PE.config", script}});
  run("stand " + path("project.3mf") + " --best-effort -o " + path("out.3mf"));
  const std::string said = text_of("stdout") + text_of("stderr");
  EXPECT_NE(said.find("scripts in them) were ignored and are not written"), std::string::npos) << said;
  EXPECT_FALSE(fs::exists(path("owned")));
  ASSERT_TRUE(fs::exists(path("out.3mf")));
  EXPECT_EQ(text_of("out.3mf").find("Slic3r"), std::string::npos);
  EXPECT_EQ(text_of("out.3mf").find("post_process"), std::string::npos);
}

}  // namespace
}  // namespace aplomb
