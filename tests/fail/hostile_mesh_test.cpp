// Text and binary mesh files that lie, break off or hold what no mesh has: an error that names the place, never a
// crash.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/expect_refused.h"
#include "support/mesh_files.h"
#include "support/shapes.h"

namespace aplomb::test {
namespace {

using namespace std::string_literals;

const std::vector<float> kFacet{0, 0, 0, 1, 0, 0, 0, 1, 0};
constexpr std::string_view kPlyHead =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";

TEST(HostileMesh, CountsThatLieAreFoundBeforeAnythingIsAllocated) {
  for (const std::uint32_t count : {2u, 85899346u, 0x80000000u, 0xffffffffu})  // 85899346 * 50 wraps around 2^32
    expect_refused(binary_stl(count, kFacet), "a.stl", "facets");
  expect_refused(binary_stl(0, {}), "a.stl", "no triangles");
  for (const std::string count : {"99", "4294967295", "18446744073709551615"}) {
    expect_refused("OFF\n" + count + " 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off", "line 2");
    expect_refused(
        std::string(kPlyHead) + "element face " + count + "\nproperty list int int vertex_indices\nend_header\n",
        "a.ply", "promises");
  }
  expect_refused("OFF\n0 0 0\n", "a.off", "no triangles");
  expect_refused("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "a.off", "no triangles");
  expect_refused("OFF\n0 1 0\n3 0 1 2\n", "a.off", "line 3");
  expect_refused("OFF\n-3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off", "line 2");
  expect_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n", "a.off", "line 6");
  expect_refused(std::string(kPlyHead) + "element face -1\nproperty list int int vertex_indices\nend_header\n", "a.ply",
                 "line 7");
}

TEST(HostileMesh, IndicesOutOfRangeNameTheirLine) {
  for (const char* index : {"4", "0", "-4", "99999999999", "9223372036854775808", "1.5", "x"}) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 ";
    expect_refused(text + index + "\n", "a.obj", "line 4");
  }
  for (const char* index : {"3", "-1", "4294967296", "nan"}) {
    expect_refused(std::string("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 ") + index + "\n", "a.off", "line 6");
    const std::string tail = std::string("0 0 0\n1 0 0\n0 1 0\n3 0 1 ") + index + "\n";
    expect_refused(
        std::string(kPlyHead) + "element face 1\nproperty list int double vertex_indices\nend_header\n" + tail, "a.ply",
        "face 0");
  }
}

TEST(HostileMesh, CoordinatesThatAreNoFiniteNumbersNameTheirPlace) {
  const std::string zeros(400, '0');
  for (const std::string& value : std::vector<std::string>{
           "nan", "inf", "-inf", "1e400", "1e39", "0x10", "1,5", "--1", "", "+-1", "1" + zeros + "e-1",
           "1" + zeros + zeros + ".5e-300", "1e9" + zeros, "0." + zeros + "1e99999999999999999999"}) {
    expect_refused("v 0 0 0\nv 1 0 " + value + "\nv 0 1 0\nf 1 2 3\n", "a.obj", "line 2");
    expect_refused("OFF\n3 1 0\n0 0 0\n1 0 " + value + "\n0 1 0\n3 0 1 2\n", "a.off", "line 4");
    expect_refused("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 " + value + "\n", "a.stl", "line 4");
  }
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<float> two = kFacet;
    two.insert(two.end(), {0, 0, 0, 1, bad, 0, 0, 1, 0});
    expect_refused(binary_stl(2, two), "a.stl", "facet 2");
  }
}

TEST(HostileMesh, ACoordinateThatIsMissingIsCalledTheEndOfTheLine) {
  expect_refused("v 0 0 0\nv 1 0 \nv 0 1 0\nf 1 2 3\n", "a.obj", "line 2: expected a finite coordinate, found the end");
  expect_refused("OFF\n3 1 0\n0 0 0\n", "a.off", "found the end");
}

TEST(HostileMesh, NumbersTooSmallForDoubleAreZero) {
  const auto file = read_text("v 0 0 1e-400\nv 1 0 -1e-999\nv 0 1 1e-310\nf 1 2 3\n", "a.obj");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->objects[0].mesh.vertices[0].z, 0);
  EXPECT_EQ(file->objects[0].mesh.vertices[1].z, 0);
  const std::string zeros(400, '0');
  for (const std::string& small : {"0." + zeros + "1", "0." + zeros + "1e20", "." + zeros + "9E+1", "1e-9" + zeros}) {
    const auto read = read_text("v 0 0 " + small + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
    ASSERT_TRUE(read) << small;
    EXPECT_EQ(read->objects[0].mesh.vertices[0].z, 0) << small;
  }
}

TEST(HostileMesh, AFileCutOffAnywhereIsAnErrorOrAValidMesh) {
  const TriangleMesh mesh = tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& [format, name] : {std::pair{MeshFormat::stl, "a.stl"},
                                     {MeshFormat::obj, "a.obj"},
                                     {MeshFormat::ply, "a.ply"},
                                     {MeshFormat::three_mf, "a.3mf"}})
    files.emplace_back(name, text_of(encode_mesh(mesh, format).value()));
  files.emplace_back("b.stl",
                     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                     "0\nendloop\nendfacet\nendsolid a\n");
  files.emplace_back("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  files.emplace_back(
      "b.ply", std::string(kPlyHead) +
                   "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  for (const auto& [name, whole] : files) {
    ASSERT_TRUE(read_text(whole, name)) << name;
    for (std::size_t length = 0; length < whole.size(); ++length) {
      const auto file =
          read_mesh(bytes_of(whole.substr(0, length)), name);  // a copy of its own: ASan sees every overrun
      if (file) {
        EXPECT_NO_THROW(corner_positions(file->objects[0].mesh));
      } else {
        EXPECT_EQ(file.error().code, ErrorCode::unusable_input) << name << " " << length << file.error().message;
      }
    }
  }
}

TEST(HostileMesh, AnyByteChangedIsAnErrorOrAValidMesh) {
  const TriangleMesh mesh = tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  for (const auto& [format, name] : {std::pair{MeshFormat::stl, "a.stl"},
                                     {MeshFormat::obj, "a.obj"},
                                     {MeshFormat::ply, "a.ply"},
                                     {MeshFormat::three_mf, "a.3mf"}}) {
    const std::string whole = text_of(encode_mesh(mesh, format).value());
    for (std::size_t at = 0; at < whole.size(); ++at)
      for (const int flip : {1, 0x80, 0xff}) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ flip);
        const auto file = read_mesh(bytes_of(changed), name);
        if (!file) continue;
        for (const MeshObject& object : file->objects) EXPECT_NO_THROW(corner_positions(object.mesh));
      }
  }
}

TEST(HostileMesh, AsciiStlOutOfOrderNamesTheLine) {
  expect_refused("solid\nvertex 0 0 0\n", "a.stl", "line 2");
  expect_refused("solid\nfacet normal 0 0 1\nfacet normal 0 0 1\n", "a.stl", "line 3");
  expect_refused("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n", "a.stl",
                 "line 7");
  expect_refused("solid\nfacet normal 0 0 1\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 0\n", "a.stl",
                 "line 6");
  expect_refused("solid\nfrobnicate\n", "a.stl", "line 2");
}

TEST(HostileMesh, TextThatIsNoMeshIsToldApart) {
  expect_refused("", "a.stl", "empty");
  expect_refused("hello", "a.stl", "neither");
  expect_refused("hello", "a.txt", "neither");
  expect_refused("\xFF\xFEs\0o\0l\0i\0d\0"s, "a.stl", "UTF-16");
  expect_refused("v 0 0\0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"s, "a.obj", "line 1");
  expect_refused("v 0 0 0\n", "a.obj", "no triangles");
  expect_refused("not a zip", "a.3mf", "zip");
  expect_refused("nOFF\n3\n3 1 0\n", "a.off", "line 1");
  expect_refused(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty list int float x\nproperty float y\nproperty float "
      "z\nend_header\n"
      "1 0 0 0 1 1 0 0 1 0 1 0 ",
      "a.ply", "lack");
  expect_refused("ply\nformat ascii 1.0\nelement vertex 1\nproperty quaternion x\n", "a.ply", "line 4");
  expect_refused("ply\nformat ascii 1.0\nelement vertex 1\nelement vertex 1\n", "a.ply", "line 4");
}

TEST(HostileMesh, WordsAndLinesOfAnyLengthAreReadInPlace) {
  const std::string name(50'000'000, 'n');
  EXPECT_TRUE(read_text("o " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", "a.obj"));
  expect_refused("v 0 0 " + name + "\n", "a.obj", "nnn...\"");
  EXPECT_LT(read_text("v 0 0 " + name + "\n", "a.obj").error().message.size(), 200u);
  expect_refused("v 0 0 " + std::string(5'000'000, '9') + "\n", "a.obj", "line 1");
}

TEST(HostileMesh, BudgetsHoldForEveryFormat) {
  const TriangleMesh mesh = sphere({}, 10, 5);  // 20480 triangles
  for (const auto& [format, name] : {std::pair{MeshFormat::stl, "a.stl"},
                                     {MeshFormat::obj, "a.obj"},
                                     {MeshFormat::ply, "a.ply"},
                                     {MeshFormat::three_mf, "a.3mf"}}) {
    const auto bytes = encode_mesh(mesh, format).value();
    EXPECT_TRUE(read_mesh(bytes, name, {.max_triangles = 20480}));
    EXPECT_EQ(read_mesh(bytes, name, {.max_triangles = 20479}).error().code, ErrorCode::over_budget) << name;
    EXPECT_EQ(read_mesh(bytes, name, {.memory_bytes = 1 << 20}).error().code, ErrorCode::over_budget) << name;
  }
}

TEST(HostileMesh, PolygonsTooLargeToCutAreRefusedInTime) {
  std::string text, face = "f";
  for (int i = 1; i <= 200000; ++i) {  // a spiral of saw teeth, nowhere convex
    const double radius = 1 + i * 1e-5 + (i % 2) * 1e-6;
    text += "v " + std::to_string(radius * std::cos(i * 0.001)) + " " + std::to_string(radius * std::sin(i * 0.001)) +
            " 0\n";
    face += " " + std::to_string(i);
  }
  const auto file = read_text(text + face + "\n", "a.obj");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::over_budget);
}

TEST(HostileMesh, MissingFilesAndDirectoriesAreFileErrors) {
  const TempFolder folder;
  EXPECT_EQ(read_mesh(folder / "missing.stl").error().code, ErrorCode::file_system);
  EXPECT_EQ(read_mesh(folder.path()).error().code, ErrorCode::file_system);
  write_text(folder / "empty.stl", "");
  EXPECT_EQ(read_mesh(folder / "empty.stl").error().code, ErrorCode::unusable_input);
}

TEST(HostileMesh, NamesOfFilesAreShownWithoutWhatATerminalWouldObey) {
  const TempFolder folder;
  const std::filesystem::path name = folder / "a\x1b]0;owned\x07\n.stl";
  EXPECT_EQ(read_mesh(name).error().message.find('\x1b'), std::string::npos);
  write_text(name, "no mesh");
  const auto file = read_mesh(name);
  ASSERT_FALSE(file);
  EXPECT_EQ(lack_of_refusal(file.error().message, (folder / "a?]0;owned??.stl").string()), "") << file.error().message;
  write_text(name, std::string(1 << 20, 'x'));
  EXPECT_EQ(read_mesh(name, {.memory_bytes = 1 << 20}).error().message.find('\x1b'), std::string::npos);
}

TEST(HostileMesh, EveryOptionOutOfItsRangeIsNamed) {
  EXPECT_NE(find_problem(ReadOptions{.max_triangles = 0}).find("max_triangles"), std::string::npos);
  EXPECT_NE(find_problem(ReadOptions{.memory_bytes = 7}).find("memory_bytes"), std::string::npos);
  EXPECT_EQ(read_text("OFF", "a.off", {.max_triangles = 0}).error().code, ErrorCode::invalid_option);
  EXPECT_EQ(find_problem(ReadOptions{}), "");
}

TEST(HostileMesh, ReadingIsCancelledAtEveryReport) {
  const TriangleMesh mesh = sphere({}, 10, 3);
  for (const auto& [format, name] : {std::pair{MeshFormat::stl, "a.stl"},
                                     {MeshFormat::obj, "a.obj"},
                                     {MeshFormat::ply, "a.ply"},
                                     {MeshFormat::three_mf, "a.3mf"}}) {
    const auto bytes = encode_mesh(mesh, format).value();
    for (int stop = 1;; ++stop) {
      int reports = 0;
      const auto file = read_mesh(bytes, name, {}, Job([&](double, std::string_view) { return ++reports != stop; }));
      if (reports < stop) break;
      ASSERT_FALSE(file) << name << stop;
      EXPECT_EQ(file.error().code, ErrorCode::cancelled);
    }
  }
}

}  // namespace
}  // namespace aplomb::test
