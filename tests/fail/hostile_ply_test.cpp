// PLY in ASCII and in both byte orders: counts, indices and coordinates that no mesh has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "support/expect_refused.h"
#include "support/mesh_files.h"

namespace aplomb::test {
namespace {

constexpr const char* binary_formats[] = {"binary_little_endian", "binary_big_endian"};

/// Appends numbers as a binary PLY of this format has them.
class Binary {
 public:
  explicit Binary(std::string_view format) : is_big_(format == "binary_big_endian") {}
  template <class T>
  Binary& add(std::initializer_list<T> values) {
    for (const T value : values) {
      std::string raw(sizeof value, '\0');
      std::memcpy(raw.data(), &value, sizeof value);
      if (is_big_) std::reverse(raw.begin(), raw.end());
      bytes_ += raw;
    }
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool is_big_;
  std::string bytes_;
};

/// Three vertices and `elements`, whose lines end the header.
std::string head(const std::string& format, const std::string& elements, const std::string& type = "float",
                 const std::string& vertices = "3") {
  std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + vertices;
  for (const char* axis : {"x", "y", "z"}) text += "\nproperty " + type + " " + axis;
  return text + "\n" + elements + "end_header\n";
}

std::string faces(const std::string& count, const std::string& types = "uchar int") {
  return "element face " + count + "\nproperty list " + types + " vertex_indices\n";
}

const std::initializer_list<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(HostilePly, TheFilesThatTheOthersBreakAreGood) {
  for (const char* format : binary_formats) {
    const std::string data = Binary(format).add(corners).add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2}).bytes();
    const auto file = read_text(head(format, faces("1")) + data, "a.ply");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->objects.at(0).mesh.vertices.at(1), (Vec3{1, 0, 0}));
  }
}

TEST(HostilePly, CountsOfNoneAreNoMeshAndCountsThatLieAreFoundFromTheHeader) {
  expect_refused(head("ascii", faces("0"), "float", "0"), "a.ply", "no triangles");
  expect_refused(head("ascii", faces("0")) + "0 0 0\n1 0 0\n0 1 0\n", "a.ply", "no triangles");
  expect_refused(head("ascii", faces("1"), "float", "0") + "3 0 1 2\n", "a.ply", "face 0");
  for (const char* format : binary_formats) {
    const std::string data = Binary(format).add(corners).bytes();
    expect_refused(head(format, faces("0"), "float", "0"), "a.ply", "no triangles");
    expect_refused(head(format, faces("0")) + data, "a.ply", "no triangles");
    for (const char* count : {"99", "4294967295", "18446744073709551615"}) {
      expect_refused(head(format, faces(count)) + data, "a.ply", "promises");
      expect_refused(head(format, "", "double", count) + data, "a.ply", "promises");
    }
  }
}

TEST(HostilePly, ListsInBinaryThatAreLongerThanTheFileNameTheirElement) {
  for (const char* format : binary_formats) {
    const auto vertices = [format] { return Binary(format).add(corners); };
    expect_refused(head(format, faces("1", "uint int")) +
                       vertices().add<std::uint32_t>({0xffffffff}).add<std::int32_t>({0, 1, 2}).bytes(),
                   "a.ply", "face 0");
    expect_refused(
        head(format, faces("1", "char int")) + vertices().add<std::int8_t>({-1}).add<std::int32_t>({0, 1, 2}).bytes(),
        "a.ply", "face 0");
    expect_refused(head(format, "element other 1\nproperty list int double x\n") +
                       vertices().add<std::int32_t>({0x7fffffff}).bytes(),
                   "a.ply", "element \"other\" 0");
  }
}

TEST(HostilePly, IndicesOutOfRangeInBinaryFacesAndStripsNameTheirElement) {
  for (const char* format : binary_formats) {
    const auto with = [format](const auto& face) {
      return Binary(format).add(corners).add<std::uint8_t>({3}).add(face);
    };
    for (const std::int32_t bad : {3, -1, -3, std::numeric_limits<std::int32_t>::max()})
      expect_refused(head(format, faces("1")) + with(std::initializer_list<std::int32_t>{0, 1, bad}).bytes(), "a.ply",
                     "face 0");
    for (const std::uint32_t bad : {3u, 0xffffffffu})
      expect_refused(
          head(format, faces("1", "uchar uint")) + with(std::initializer_list<std::uint32_t>{0, 1, bad}).bytes(),
          "a.ply", "face 0");
    for (const double bad : {0.5, 3.0, -1.0, 1e300, std::numeric_limits<double>::quiet_NaN()})
      expect_refused(head(format, faces("1", "uchar double")) + with(std::initializer_list<double>{0, 1, bad}).bytes(),
                     "a.ply", "face 0");
    const std::string strips = "element tristrips 1\nproperty list uchar int vertex_indices\n";
    for (const std::int32_t bad : {3, -2})
      expect_refused(head(format, strips) + with(std::initializer_list<std::int32_t>{0, 1, bad}).bytes(), "a.ply",
                     "tristrips 0");
    expect_refused(head(format, strips) + with(std::initializer_list<std::int32_t>{0, -1, 1}).bytes(), "a.ply",
                   "no triangles");
    expect_refused(head(format, strips) + with(std::initializer_list<std::int32_t>{0, 1}).bytes(), "a.ply",
                   "tristrips 0");
  }
}

TEST(HostilePly, CoordinatesThatAreNoFiniteFloatsNameTheirVertex) {
  for (const std::string value : {"nan", "inf", "-inf", "1e39", "1e400", "0x10", "1,5", "--1", "+-1", "x"})
    expect_refused(head("ascii", faces("1")) + "0 0 0\n1 0 " + value + "\n0 1 0\n3 0 1 2\n", "a.ply", "vertex 1");
  for (const char* format : binary_formats) {
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {nan, inf, -inf})
      expect_refused(head(format, "") + Binary(format).add<float>({0, 0, 0, 1, bad, 0, 0, 1, 0}).bytes(), "a.ply",
                     "vertex 1");
    for (const double bad : {double{nan}, double{inf}, 1e39, -1e308})
      expect_refused(head(format, "", "double") + Binary(format).add<double>({0, 0, 0, 1, 0, bad, 0, 1, 0}).bytes(),
                     "a.ply", "vertex 1");
  }
}

TEST(HostilePly, HeadersWithoutWhatAMeshNeedsNameTheirLine) {
  expect_refused("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", "a.ply", "line 3");
  expect_refused(head("ascii", "element face 1\nproperty int a\n") + "0 0 0\n1 0 0\n0 1 0\n1\n", "a.ply", "line 7");
}

}  // namespace
}  // namespace aplomb::test
