// Zips that lie: overlapping entries, entries of zip64 that claim what is not there, truncated and garbled archives;
// and 3MF parts without what they need.
#include <gtest/gtest.h>

#include "support/expect_refused.h"
#include "support/mesh_files.h"
#include "support/zip_files.h"

namespace aplomb::test {
namespace {

const std::string good_model = model_xml(tetrahedron_object(1), "<item objectid=\"1\"/>");

/// Fails unless reading ends in a mesh whose indices hold or in a sentence as it is promised.
void expect_sound_or_refused(const std::string& bytes) {
  const auto file = read_text(bytes, "a.3mf");
  if (file)
    for (const MeshObject& object : file->objects) EXPECT_NO_THROW(corner_positions(object.mesh));
  else EXPECT_EQ(lack_of_refusal(file.error().message, "a.3mf"), "") << file.error().message;
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
  put(zip, second + 42, 0, 4);  // its local header, of the relationships, is now the first entry's
  expect_refused(zip, "a.3mf", "part \"_rels/.rels\"");
  zip = package(good_model, {{"a", "unused"}, {"b", "unused"}});
  put(zip, zip.find("PK\x01\x02", zip.find("PK\x01\x02") + 4) + 42, 0, 4);
  const auto file = read_text(zip, "a.3mf");  // of what is not read nothing is asked
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->objects.at(0).mesh.triangles.size(), 4u);
}

/// What a plain end record may say beside one of 64 bits, true or not.
std::vector<EndRecord> plain_records_for(const EndRecord& whole) {
  return {{0xffff, 0xffffffff, 0xffffffff}, whole, {}, {1, 46, 0}, {whole.entries, whole.size, 0xffffffff}};
}

TEST(HostileZip, ZipsOf64BitsThatPointBeyondTheFileAreRefused) {
  const std::string zip = package(good_model);
  const EndRecord whole = end_record_of(zip);
  for (const EndRecord& plain : plain_records_for(whole)) {
    const std::string sound = with_end_records(zip, plain, whole);
    const std::size_t record = sound.rfind("PK\x06\x06"), locator = sound.rfind("PK\x06\x07");
    for (const std::uint64_t lie : {std::uint64_t{0}, std::uint64_t{1} << 40, ~std::uint64_t{0}})
      for (const std::size_t field : {record + 24, record + 32, record + 40, record + 48, locator + 8}) {
        std::string changed = sound;
        put(changed, field, lie, 8);
        expect_sound_or_refused(changed);
      }
    std::string cut = sound;
    put(cut, locator + 8, cut.size() - 4, 8);
    expect_refused(cut, "a.3mf", "zip");
  }
}

TEST(HostileZip, AnArchiveOf64BitsIsReadAndItsDirectoryIsLimitedWhateverThePlainRecordSays) {
  const std::string small = package(good_model);
  std::vector<ZipEntry> many;
  for (int i = 0; i < 6'000; ++i) many.push_back({std::to_string(i), ""});
  const std::string large = package(good_model, many);
  EXPECT_TRUE(
      read_text(with_end_records(small, plain_records_for(end_record_of(small))[0], end_record_of(small)), "a.3mf"));
  for (const EndRecord& plain : plain_records_for(end_record_of(large)))
    expect_refused(with_end_records(large, plain, end_record_of(large)), "a.3mf", "directory");
  expect_refused(large, "a.3mf", "directory");
  EndRecord fewer = end_record_of(large);
  fewer.entries = 3;
  expect_refused(with_end_records(large, fewer), "a.3mf", "directory");
  many.resize(4'900);
  EXPECT_TRUE(read_text(package(good_model, many), "a.3mf"));
}

TEST(HostileZip, AnArchiveInsideAnArchiveIsNoModel) {
  expect_refused(zip_of({{"3D/3dmodel.model", package(good_model)}}), "a.3mf", "XML");
  expect_refused(zip_of({{"model.zip", package(good_model)}}), "a.3mf", "no 3D model");
  expect_refused(zip_of({}), "a.3mf", "no 3D model");
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
    expect_refused(package(model), "a.3mf", "part \"");
  }
}

TEST(HostileZip, ReferencesToObjectsThatComeLaterOrFailedAreResolvedOrNamed) {
  const std::string user = "<object id=\"2\"><components><component objectid=\"1\"/></components></object>";
  const auto file = read_text(package(model_xml(user + tetrahedron_object(1), "<item objectid=\"2\"/>")), "a.3mf");
  ASSERT_TRUE(file) << file.error().message;  // forward: the specification forbids it, nothing is unclear about it
  EXPECT_EQ(file->objects.at(0).mesh.triangles.size(), 4u);
  const std::string broken = "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\"/></vertices></mesh></object>";
  expect_refused(package(model_xml(broken + user, "<item objectid=\"2\"/>")), "a.3mf", "vertex 0");
}

}  // namespace
}  // namespace aplomb::test
