// Zips that lie: overlapping entries, entries of zip64 that claim what is not there, truncated and garbled archives;
// and 3MF parts without what they need.
#include <gtest/gtest.h>

#include "support/mesh_files.h"
#include "support/zip_files.h"

namespace aplomb::test {
namespace {

const std::string good_model = model_xml(tetrahedron_object(1), "<item objectid=\"1\"/>");

/// Fails unless reading ends in a mesh whose indices hold or in one sentence with a remedy.
void expect_sound_or_refused(const std::string& bytes) {
  const auto file = read_text(bytes, "a.3mf");
  if (file)
    for (const MeshObject& object : file->objects) EXPECT_NO_THROW(corner_positions(object.mesh));
  else EXPECT_NE(file.error().message.find(';'), std::string::npos) << file.error().message;
}

void expect_refused(const std::string& bytes, std::string_view words) {
  const auto file = read_text(bytes, "a.3mf");
  ASSERT_FALSE(file) << words;
  EXPECT_EQ(file.error().code, ErrorCode::unusable_input);
  EXPECT_NE(file.error().message.find(words), std::string::npos) << file.error().message;
  EXPECT_NE(file.error().message.find(';'), std::string::npos) << file.error().message;
}

void put(std::string& bytes, std::size_t at, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.at(at + i) = static_cast<char>(value >> (8 * i));
}

TEST(HostileZip, OffsetsSizesAndCountsOfEveryFieldMayLie) {
  const std::string zip = package(good_model);
  const std::size_t directory = zip.find("PK\x01\x02"), end = zip.find("PK\x05\x06");
  for (const std::uint64_t lie : {0ull, 1ull, 0x7fffffffull, 0xfffffffeull, 0xffffffffull})
    for (std::size_t at = directory; at + 4 <= zip.size(); ++at) {
      std::string changed = zip;
      put(changed, at, lie, at >= end ? 2 : 4);
      expect_sound_or_refused(changed);
    }
}

TEST(HostileZip, TwoEntriesOverTheSameBytesAreNoMoreThanTwoParts) {
  std::string zip = package(good_model, {{"3D/b.model", good_model}});
  const std::size_t second = zip.find("PK\x01\x02", zip.find("PK\x01\x02") + 4);
  put(zip, second + 42, 0, 4);  // its local header is now the first entry's
  expect_sound_or_refused(zip);
}

TEST(HostileZip, ZipsOf64BitsThatPointBeyondTheFileAreRefused) {
  std::string zip = package(good_model);
  const std::size_t end = zip.find("PK\x05\x06");
  std::string record = "PK\x06\x06" + std::string(52, '\0'), locator = "PK\x06\x07" + std::string(16, '\0');
  put(record, 4, 44, 8);
  put(locator, 16, 1, 4);
  for (const std::uint64_t lie : {std::uint64_t{0}, std::uint64_t{1} << 40, ~std::uint64_t{0}})
    for (const std::size_t field : {24u, 32u, 40u, 48u}) {
      std::string changed = record;
      put(changed, field, lie, 8);
      std::string pointer = locator;
      put(pointer, 8, end, 8);
      std::string tail = zip.substr(end);
      put(tail, 8, 0xffff, 2);
      put(tail, 10, 0xffff, 2);
      put(tail, 12, 0xffffffff, 4);
      put(tail, 16, 0xffffffff, 4);
      expect_sound_or_refused(zip.substr(0, end) + changed + pointer + tail);
      put(pointer, 8, lie, 8);
      expect_sound_or_refused(zip.substr(0, end) + changed + pointer + tail);
    }
}

TEST(HostileZip, AnArchiveInsideAnArchiveIsNoModel) {
  expect_refused(zip_of({{"3D/3dmodel.model", package(good_model)}}), "XML");
  expect_refused(zip_of({{"model.zip", package(good_model)}}), "no 3D model");
  expect_refused(zip_of({}), "no 3D model");
}

TEST(HostileZip, NamesOfEntriesThatAreEmptyLongBinaryOrPathsAreKeysOnly) {
  for (const std::string& name :
       {std::string(), std::string("/"), std::string(60'000, 'x'), std::string("\xff\xfe\x1b[2J"),
        std::string("C:\\Windows\\x"), std::string("../../x"), std::string("a\0b", 3)})
    EXPECT_TRUE(read_text(package(good_model, {{name, "x"}}), "a.3mf")) << name.substr(0, 20);
}

TEST(HostileZip, ModelsWithoutTheirAttributesOrElementsAreRefusedWithTheirPlace) {
  for (const char* missing : {" id=\"1\"", " objectid=\"1\"", " x=\"0\"", " y=\"0\"", " z=\"0\"", " v1=\"0\"",
                              " v2=\"2\"", "<mesh>", "<vertices>", "<triangles>", "<build>", "<resources>"}) {
    std::string model = good_model;
    const std::size_t at = model.find(missing);
    const std::size_t from = at != model.npos ? at : model.find(missing + 1);
    ASSERT_NE(from, model.npos) << missing;
    model.erase(from, std::string_view(missing).size() - (at != model.npos ? 0 : 1));
    expect_refused(package(model), "part \"");
  }
}

TEST(HostileZip, ReferencesToObjectsThatComeLaterOrFailedAreResolvedOrNamed) {
  const std::string user = "<object id=\"2\"><components><component objectid=\"1\"/></components></object>";
  const auto file = read_text(package(model_xml(user + tetrahedron_object(1), "<item objectid=\"2\"/>")), "a.3mf");
  ASSERT_TRUE(file) << file.error().message;  // forward: the specification forbids it, nothing is unclear about it
  EXPECT_EQ(file->objects.at(0).mesh.triangles.size(), 4u);
  const std::string broken = "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\"/></vertices></mesh></object>";
  expect_refused(package(model_xml(broken + user, "<item objectid=\"2\"/>")), "vertex 0");
}

}  // namespace
}  // namespace aplomb::test
