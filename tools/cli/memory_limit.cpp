#include "memory_limit.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <string_view>
#include <thread>

#include "interrupt.h"

namespace aplomb::cli {
namespace {

/// What the process holds in memory that is backed by no file; 0 where that cannot be read. Allocates nothing.
std::size_t held_bytes(int statm, std::size_t page_bytes) {
  std::array<char, 128> text{};
  const ssize_t count = pread(statm, text.data(), text.size(), 0);
  if (count <= 0) return 0;
  const char *at = text.data(), *end = at + count;
  std::array<std::size_t, 3> pages{};  // in all, resident, of those in files
  for (std::size_t& value : pages) {
    at = std::from_chars(at, end, value).ptr;
    if (at != end) ++at;
  }
  return (pages[1] - pages[2]) * page_bytes;
}

void watch(int statm, std::size_t most_bytes, int exit_code) {
  const auto page_bytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  while (held_bytes(statm, page_bytes) <= most_bytes) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  remove_temp_file();
  constexpr std::string_view said =
      "aplomb: the memory allowed is used up (--memory); allow more, or take a larger --voxel\n";
  [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, said.data(), said.size());
  _exit(exit_code);
}

}  // namespace

void limit_memory(std::size_t bytes, int exit_code) {
  const int statm = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (statm < 0) return;
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);  // signals are for those who work
  std::thread(watch, statm, bytes, exit_code).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace aplomb::cli
