// Writing a file whole or not at all.
#include "aplomb/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/mesh_files.h"
#include "support/shapes.h"

namespace aplomb::test {
namespace {

namespace fs = std::filesystem;

TEST(AtomicFile, ReplacesTheWholeContentAndLeavesNothingBeside) {
  const TempFolder folder;
  write_text(folder / "a", "something much longer than what follows");
  ASSERT_TRUE(write_file_atomically(folder / "a", bytes_of("new")));
  EXPECT_EQ(read_text_file(folder / "a"), "new");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, TheTargetIsUntouchedUntilTheNewFileIsComplete) {
  const TempFolder folder;
  write_text(folder / "a", "old");
  std::vector<fs::path> told;
  std::string seen_at_end;
  const auto listener = [&](const fs::path& temp) {
    told.push_back(temp);
    EXPECT_FALSE(fs::exists(temp) && !temp.empty());
    seen_at_end = read_text_file(folder / "a");
  };
  ASSERT_TRUE(write_file_atomically(folder / "a", bytes_of("new"), listener));
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].parent_path(), folder.path());
  EXPECT_TRUE(told[1].empty());
  EXPECT_EQ(seen_at_end, "new");
}

TEST(AtomicFile, WritesThroughASymbolicLinkEvenOneThatDangles) {
  const TempFolder folder;
  fs::create_directory(folder / "real");
  fs::create_symlink("real/target", folder / "link");
  for (const char* content : {"first", "second"}) {
    ASSERT_TRUE(write_file_atomically(folder / "link", bytes_of(content)));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_text_file(folder / "real/target"), content);
  }
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(AtomicFile, KeepsThePermissionsOfWhatItReplaces) {
  const TempFolder folder;
  write_text(folder / "a", "old");
  fs::permissions(folder / "a", static_cast<fs::perms>(0640));
  ASSERT_TRUE(write_file_atomically(folder / "a", bytes_of("new")));
  EXPECT_EQ(fs::status(folder / "a").permissions(), static_cast<fs::perms>(0640));
}

TEST(AtomicFile, ReachesTheLongestNamesAndUnicode) {
  const TempFolder folder;
  for (const std::string& name : {std::string(255, 'x'), std::string("f\xC3\xBC\xC3\x9F \xE7\xAB\x8B.3mf")}) {
    ASSERT_TRUE(write_file_atomically(folder / name, bytes_of("content")));
    EXPECT_EQ(read_text_file(folder / name), "content");
  }
}

TEST(AtomicFile, WritesStraightIntoWhatIsNoRegularFile) {
  EXPECT_TRUE(write_file_atomically("/dev/null", bytes_of("content")));
  struct stat status {};
  ASSERT_EQ(::stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST(AtomicFile, AMeshMayBeWrittenOverTheFileItCameFrom) {
  const TempFolder folder;
  const TriangleMesh mesh = box({0, 0, 0}, {1, 2, 3});
  ASSERT_TRUE(write_mesh(folder / "a.3mf", mesh));
  const auto file = read_mesh(folder / "a.3mf");
  ASSERT_TRUE(write_mesh(folder / "a.3mf", file->objects[0].mesh));
  EXPECT_EQ(read_mesh(folder / "a.3mf")->objects[0].mesh, mesh);
}

}  // namespace
}  // namespace aplomb::test
