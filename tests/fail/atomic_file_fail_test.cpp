// What cannot be written is said, and leaves nothing behind.
#include <gtest/gtest.h>
#include <unistd.h>

#include "support/mesh_files.h"
#include "support/shapes.h"

namespace aplomb::test {
namespace {

namespace fs = std::filesystem;

void expect_file_error(const fs::path& target) {
  const auto written = write_file_atomically(target, bytes_of("content"));
  ASSERT_FALSE(written) << target;
  EXPECT_EQ(written.error().code, ErrorCode::file_system);
  EXPECT_NE(written.error().message.find(target.string()), std::string::npos) << written.error().message;
}

TEST(AtomicFileFails, OnAMissingFolderADirectoryAFileAsFolderAndALinkInACircle) {
  const TempFolder folder;
  write_text(folder / "file", "old");
  fs::create_symlink("circle", folder / "circle");
  expect_file_error(folder / "missing/a.stl");
  expect_file_error(folder.path());
  expect_file_error(folder / "file/a.stl");
  expect_file_error(folder / "circle");
  expect_file_error(folder / std::string(256, 'x'));
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(AtomicFileFails, ToHandOnThatAFileRunsAsItsOwner) {
  const TempFolder folder;
  write_text(folder / "tool", "old");
  const fs::perms asked = fs::perms::owner_all | fs::perms::group_read | fs::perms::set_uid | fs::perms::set_gid;
  fs::permissions(folder / "tool", asked);
  ASSERT_EQ(fs::status(folder / "tool").permissions(), asked);
  ASSERT_TRUE(write_file_atomically(folder / "tool", bytes_of("content")));
  EXPECT_EQ(fs::status(folder / "tool").permissions(), fs::perms::owner_all | fs::perms::group_read);
}

TEST(AtomicFileFails, OnAFullDisk) { expect_file_error("/dev/full"); }

/// Root may write everywhere, and so takes another identity meanwhile.
class AsOrdinaryUser {
 public:
  AsOrdinaryUser() {
    if (was_root_) become(65534);
  }
  ~AsOrdinaryUser() {
    if (was_root_) become(0);
  }

 private:
  static void become(uid_t user) { EXPECT_EQ(::seteuid(user), 0); }

  bool was_root_ = ::geteuid() == 0;
};

TEST(AtomicFileFails, WithoutWhatATerminalWouldObeyInTheName) {
  const auto written = write_file_atomically("missing/a\x1b[2J", bytes_of("content"));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message.find('\x1b'), std::string::npos);
}

TEST(AtomicFileFails, InAReadOnlyFolderAndOnAReadOnlyFile) {
  const AsOrdinaryUser user;
  const TempFolder folder;
  write_text(folder / "file", "old");
  fs::permissions(folder / "file", fs::perms::owner_read);
  expect_file_error(folder / "file");
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  expect_file_error(folder / "new");
  EXPECT_EQ(read_text_file(folder / "file"), "old");
  EXPECT_EQ(folder.entries(), 1u);
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(WriteMeshFails, WhenThereIsNothingToWriteNoFormatOrNoRoomForACoordinate) {
  const TempFolder folder;
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(write_mesh(folder / "a.stl", {}).error().code, ErrorCode::unusable_input);
  EXPECT_EQ(write_mesh(folder / "a.step", mesh).error().code, ErrorCode::invalid_option);
  mesh.vertices[3].y = 1e39;
  EXPECT_EQ(write_mesh(folder / "a.stl", mesh).error().code, ErrorCode::unusable_input);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(WriteMeshFails, AsCancelledAtEveryReport) {
  const TriangleMesh mesh = sphere({}, 10, 4);
  for (const MeshFormat format : {MeshFormat::three_mf, MeshFormat::stl, MeshFormat::obj, MeshFormat::ply})
    for (int stop = 1;; ++stop) {
      int reports = 0;
      const auto bytes =
          encode_mesh(mesh, format, {}, Job([&](double, std::string_view) { return ++reports != stop; }));
      if (reports < stop) break;
      ASSERT_FALSE(bytes) << stop;
      EXPECT_EQ(bytes.error().code, ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace aplomb::test
