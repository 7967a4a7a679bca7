// Killed while it writes, a process leaves the old file or the complete new one, and beside it at most what it had
// begun.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <vector>

#include "support/cost.h"
#include "support/mesh_files.h"

namespace aplomb::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const std::size_t file_bytes = (is_sanitized() ? 10 : 40) * std::size_t{1'000'000};

/// The file's n-th version: as many bytes, all alike.
std::vector<std::byte> version(int n) { return std::vector<std::byte>(file_bytes, static_cast<std::byte>(n % 251)); }

/// Writes version after version until it is killed.
[[noreturn]] void write_for_ever(const fs::path& target) {
  for (int n = 1;; ++n)
    if (!write_file_atomically(target, version(n))) _exit(1);
}

/// Waits until a child has begun to write: a temporary file of its own is there.
bool begins_to_write(const fs::path& folder, pid_t child) {
  const std::string own = ".aplomb-" + std::to_string(child) + "-";
  for (int waits = 0; waits < 600'000; ++waits, usleep(100))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().starts_with(own)) return true;
  return false;
}

bool is_whole(const std::string& bytes) {
  return bytes.size() == file_bytes && std::ranges::all_of(bytes, [&](char c) { return c == bytes.front(); });
}

TEST(AtomicFile, KilledAtFiftyMomentsOfTheWriteIsOldOrNewAndWhole) {
  const TempFolder folder;
  const fs::path target = folder / "out.3mf";
  const auto start = Clock::now();
  ASSERT_TRUE(write_file_atomically(target, version(0)));
  const double write_s = std::chrono::duration<double>(Clock::now() - start).count();
  std::mt19937 random(3);
  int in_the_write = 0;
  for (int kill_number = 0; kill_number < 50; ++kill_number) {
    const pid_t child = fork();
    if (child == 0) write_for_ever(target);
    ASSERT_TRUE(begins_to_write(folder.path(), child));
    usleep(static_cast<useconds_t>(1e6 * std::uniform_real_distribution<double>(0, 2 * write_s)(random)));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "could not write";
    EXPECT_TRUE(is_whole(read_text_file(target))) << "after kill " << kill_number;
    for (const auto& entry : fs::directory_iterator(folder.path())) {
      const std::string name = entry.path().filename();
      if (name == "out.3mf") continue;
      EXPECT_TRUE(name.starts_with(".aplomb-") && name.ends_with(".tmp")) << name;
      ++in_the_write;
      fs::remove(entry.path());
    }
  }
  EXPECT_GE(in_the_write, 10) << "of 50 kills: the others came before or between writes";
}

}  // namespace
}  // namespace aplomb::test
