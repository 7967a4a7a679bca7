// What each mesh format holds, in and out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "aplomb/mesh/mass_properties.h"
#include "support/mesh_files.h"
#include "support/shapes.h"

namespace aplomb::test {
namespace {

TriangleMesh shape() { return rounded_to_float(torus({10, -3, 7}, 20, 5.3, 24, 12)); }

MeshFile read_back(const TriangleMesh& mesh, MeshFormat format, std::string_view name) {
  auto file = read_mesh(encode_mesh(mesh, format).value(), name);
  EXPECT_TRUE(file) << file.error().message;
  return file.value();
}

TEST(MeshFormats, IndexedFormatsGiveBackEveryVertexAndTriangleExactly) {
  for (const auto& [format, name, read_as] : {std::tuple{MeshFormat::obj, "a.obj", "OBJ"},
                                              {MeshFormat::ply, "a.ply", "PLY"},
                                              {MeshFormat::three_mf, "a.3mf", "3MF"}}) {
    const MeshFile file = read_back(shape(), format, name);
    ASSERT_EQ(file.objects.size(), 1u) << name;
    EXPECT_EQ(rounded_to_float(file.objects[0].mesh), shape()) << name;
    EXPECT_EQ(file.format, read_as);
  }
}

TEST(MeshFormats, BinaryStlGivesBackEveryCornerAndTheSameNumberOfVertices) {
  const MeshFile file = read_back(shape(), MeshFormat::stl, "a.stl");
  EXPECT_EQ(file.format, "binary STL");
  EXPECT_EQ(corner_positions(file.objects[0].mesh), corner_positions(shape()));
  EXPECT_EQ(file.objects[0].mesh.vertices.size(), shape().vertices.size());
}

TEST(MeshFormats, ContentDecidesAgainstTheExtension) {
  EXPECT_EQ(read_back(shape(), MeshFormat::stl, "a.obj").format, "binary STL");
  EXPECT_EQ(read_back(shape(), MeshFormat::obj, "a.stl").format, "OBJ");
  EXPECT_EQ(read_back(shape(), MeshFormat::ply, "a.3mf").format, "PLY");
}

TEST(MeshFormats, ABinaryStlWhoseHeaderBeginsWithSolidIsReadAsBinary) {
  const auto file = read_text(binary_stl(1, {0, 0, 0, 1, 0, 0, 0, 1, 0}, "solid exported by a CAD program"), "a.stl");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->format, "binary STL");
}

TEST(MeshFormats, AsciiStlIsReadWhateverItsCaseIndentationAndLineEnds) {
  const std::string text =
      "solid my part\nfacet normal 0 0 1\nouter loop\n vertex 0 0 0\n vertex 1.5e0 0 0\n vertex 0 +2 0\nendloop\n"
      "endfacet\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 0 2 0\nvertex -1 0 0\nendloop\nendfacet\n"
      "endsolid my part";
  std::string dos, shouting = text;
  for (const char c : text) (c == '\n' ? dos += '\r' : dos) += c;
  for (char& c : shouting) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const TriangleMesh expected{{{0, 0, 0}, {1.5, 0, 0}, {0, 2, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  for (const std::string& variant : {text, dos, shouting, std::string("\xEF\xBB\xBF").append(text)}) {
    const auto file = read_text(variant, "x.stl");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->format, "ASCII STL");
    EXPECT_EQ(file->objects[0].mesh, expected);
  }
  EXPECT_EQ(read_text(text, "x.stl")->objects[0].name, "my part");
}

TEST(MeshFormats, ObjTakesNegativeIndicesTextureAndNormalIndicesAndContinuedLines) {
  const std::string text =
      "# comment\nmtllib a.mtl\no part\nv 0 0 0\nv 1 0 0 # here\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
      "f 1/1/1 2//1 3/1\nf -4 \\\n -2 -1\nl 1 2";
  const auto file = read_text(text, "a.obj");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->objects[0].mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(file->objects[0].name, "part");
}

/// Area along z of the triangles a polygon is cut into; negative where one is turned over.
std::vector<double> cut_areas(const std::vector<Vec2>& polygon) {
  std::string text;
  for (const Vec2 p : polygon)
    text.append("v ").append(std::to_string(p.x)).append(" ").append(std::to_string(p.y)).append(" 3\n");
  text += "f";
  for (std::size_t i = 1; i <= polygon.size(); ++i) text += " " + std::to_string(i);
  const TriangleMesh mesh = read_text(text + "\n", "a.obj")->objects[0].mesh;
  std::vector<double> areas;
  for (const Triangle& t : mesh.triangles)
    areas.push_back(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]).z / 2);
  return areas;
}

double area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

TEST(MeshFormats, PolygonsAreCutIntoTrianglesThatCoverThemOnceWhateverTheirShape) {
  std::vector<Vec2> comb{{0, 0}, {9, 0}};
  for (int tooth = 8; tooth >= 0; --tooth) comb.push_back({static_cast<double>(tooth), tooth % 2 ? 1.0 : 5.0});
  const std::vector<std::vector<Vec2>> polygons{
      {{0, 0}, {4, 0}, {4, 4}, {0, 4}},                                  // convex
      {{0, 0}, {4, 0}, {1, 1}, {0, 4}},                                  // an arrow head
      {{1, 1}, {0, 4}, {0, 0}, {4, 0}},                                  // the same, from its dent
      {{0, 0}, {1, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {0, 4}, {0, 1}},  // corners on straight edges
      {{0, 0}, {6, 0}, {6, 6}, {2, 6}, {2, 4}, {4, 4}, {4, 2}, {0, 2}},  // a hook
      comb};
  for (const auto& polygon : polygons) {
    const std::vector<double> areas = cut_areas(polygon);
    EXPECT_EQ(areas.size(), polygon.size() - 2);
    double sum = 0;
    for (const double each : areas) sum += each;
    EXPECT_GT(*std::min_element(areas.begin(), areas.end()), 0);
    EXPECT_NEAR(sum, area(polygon), 1e-9);
  }
}

TEST(MeshFormats, WrittenStlCannotBeTakenForAscii) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(0, 100);
  for (int round = 0; round < 2000; ++round) {
    TriangleMesh mesh;
    for (int i = 0; i < 3; ++i)
      mesh.vertices.push_back({std::round(coordinate(random)), std::round(coordinate(random)), 0.5});
    mesh.triangles = {{0, 1, 2}};
    const std::string stl = text_of(encode_mesh(mesh, MeshFormat::stl).value());
    EXPECT_FALSE(stl.starts_with("solid"));
    const std::string_view window = std::string_view(stl).substr(84, 128);
    EXPECT_TRUE(std::any_of(window.begin(), window.end(), [](char c) { return static_cast<unsigned char>(c) > 127; }));
  }
}

TEST(MeshFormats, WrittenStlCarriesUnitNormalsAlongTheWinding) {
  const std::string stl = text_of(encode_mesh(box({0, 0, 0}, {1, 2, 3}), MeshFormat::stl).value());
  for (std::size_t facet = 0; facet < 12; ++facet) {
    float v[12];
    std::memcpy(v, stl.data() + 84 + 50 * facet, sizeof v);
    const Vec3 normal{v[0], v[1], v[2]}, a{v[3], v[4], v[5]}, b{v[6], v[7], v[8]}, c{v[9], v[10], v[11]};
    EXPECT_NEAR(norm(normal), 1, 1e-6);
    EXPECT_NEAR(dot(normal, normalized(cross(b - a, c - a))), 1, 1e-6);
  }
}

TEST(MeshFormats, AnStlReadAndWrittenAgainIsTheSameToTheByte) {
  const auto written = encode_mesh(sphere({0.1, 0.2, 0.3}, 10.0 / 3, 2), MeshFormat::stl).value();
  const MeshFile back = read_mesh(written, "a.stl").value();
  EXPECT_EQ(encode_mesh(back.objects.front().mesh, MeshFormat::stl).value(), written);
}

TEST(MeshFormats, TheSameMeshGivesTheSameBytes) {
  for (const MeshFormat format : {MeshFormat::three_mf, MeshFormat::stl, MeshFormat::obj, MeshFormat::ply})
    EXPECT_EQ(encode_mesh(shape(), format).value(), encode_mesh(shape(), format).value());
}

}  // namespace
}  // namespace aplomb::test
