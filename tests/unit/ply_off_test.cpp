// PLY in its three encodings, and OFF's variants.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "support/mesh_files.h"

namespace aplomb::test {
namespace {

const TriangleMesh kExpected{{{0, 0, 0}, {1.5, 0, 0}, {1.5, 2, 0}, {0, 2, -0.25}}, {{0, 1, 2}, {0, 2, 3}, {3, 1, 0}}};

TriangleMesh mesh_of(std::string_view text, std::string_view name) {
  auto file = read_text(text, name);
  EXPECT_TRUE(file) << file.error().message;
  return file ? file->objects[0].mesh : TriangleMesh{};
}

constexpr std::string_view kElements =
    "comment made in a test\nelement camera 2\nproperty int id\nproperty list uchar short lens\n"
    "element vertex 4\nproperty uchar red\nproperty double z\nproperty float x\nproperty list ushort float weights\n"
    "property float y\nelement face 2\nproperty float quality\nproperty list int16 uint32 vertex_index\nend_header\n";

template <class T>
void put(std::string& out, bool big_endian, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof raw);
  if (big_endian) std::reverse(raw, raw + sizeof raw);
  out.append(raw, sizeof raw);
}

/// kElements' data: two cameras, the four vertices, a quad and a triangle.
std::string binary_ply(bool big_endian) {
  std::string out = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n";
  out.append(kElements);
  for (int camera = 0; camera < 2; ++camera) {
    put<std::int32_t>(out, big_endian, camera);
    put<std::uint8_t>(out, big_endian, 2);
    put<std::int16_t>(out, big_endian, -7);
    put<std::int16_t>(out, big_endian, 10);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    put<std::uint8_t>(out, big_endian, 255);
    put<double>(out, big_endian, kExpected.vertices[i].z);
    put<float>(out, big_endian, static_cast<float>(kExpected.vertices[i].x));
    put<std::uint16_t>(out, big_endian, static_cast<std::uint16_t>(i));
    for (std::size_t k = 0; k < i; ++k) put<float>(out, big_endian, 0.5f);
    put<float>(out, big_endian, static_cast<float>(kExpected.vertices[i].y));
  }
  for (const std::vector<std::uint32_t>& face : {std::vector<std::uint32_t>{0, 1, 2, 3}, {3, 1, 0}}) {
    put<float>(out, big_endian, 1);
    put<std::int16_t>(out, big_endian, static_cast<std::int16_t>(face.size()));
    for (const std::uint32_t corner : face) put(out, big_endian, corner);
  }
  return out;
}

TEST(Ply, BothByteOrdersGiveTheSameMeshWhateverStandsAroundTheCoordinates) {
  EXPECT_EQ(mesh_of(binary_ply(false), "a.ply"), kExpected);
  EXPECT_EQ(mesh_of(binary_ply(true), "a.ply"), kExpected);
}

TEST(Ply, AsciiGivesTheSameMeshWithEveryLineEnd) {
  const std::string unix_text = std::string("ply\nformat ascii 1.0\n")
                                    .append(kElements)
                                    .append(
                                        "0 2 -7 10\n1 2 -7 10\n255 0 0 0 0\n255 0 1.5 1 0.5 0\n255 0 1.5 2 .5 .5 "
                                        "2\n255 -0.25 0 3 1 1 1 2\n1 4 0 1 2 3\n1 3 3 1 0");
  std::string dos, mac;
  for (const char c : unix_text) {
    if (c == '\n') dos += '\r';
    dos += c;
    mac += c == '\n' ? '\r' : c;
  }
  for (const std::string& text : {unix_text, dos, mac}) EXPECT_EQ(mesh_of(text, "a.ply"), kExpected);
}

TEST(Ply, StripsOfTrianglesKeepTheirWinding) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 1 2 3 -1 "
      "3 2 1 0\n";
  const TriangleMesh mesh = mesh_of(text, "a.ply");
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]];
    EXPECT_EQ(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a).z, 1);
  }
}

TEST(Off, EveryVariantOfTheHeaderAndOfWhatFollowsGivesTheSameMesh) {
  const std::string vertices = "0 0 0\n1.5 0 0\n1.5 2 0\n0 2 -0.25\n", faces = "4 0 1 2 3\n3 3 1 0\n";
  const std::string coloured = "0 0 0 255 0 0 255\n1.5 0 0 1 1 1 1\n1.5 2 0 0 0 0 0\n0 2 -.25 1 2 3 4\n";
  const std::vector<std::string> variants{
      "OFF\n4 2 0\n" + vertices + faces,
      "OFF 4 2 0\n" + vertices + faces,
      "# first\nOFF # really\n\n4 2 # no edges\n\n" + vertices + "# between\n" + faces,
      "COFF\n4 2 0\n" + coloured + "4 0 1 2 3 0.5 0.5 0.5\n3  3 1 0  255 0 0",
      "NOFF\r\n4 2 0\r\n0 0 0 0 0 1\r\n1.5 0 0 0 0 1\r\n1.5 2 0 0 0 1\r\n0 2 -0.25 0 0 1\r\n4 0 1 2 3\r\n3 3 1 0\r\n",
      "4 2 0\n" + vertices + faces};
  for (const std::string& text : variants) EXPECT_EQ(mesh_of(text, "a.off"), kExpected) << text;
}

}  // namespace
}  // namespace aplomb::test
