#include "aplomb/core/isolated.h"

#if !defined(__unix__) && !defined(__APPLE__)
#error \
    "run_isolated() needs fork(): without it what may crash would take the whole program along; port it before building here"
#endif

#include <fcntl.h>
#include <locale.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <utility>

namespace aplomb {
namespace {

using Clock = std::chrono::steady_clock;

/// How a child says that it ended: the first byte it writes.
enum class Ending : char { result = 'r', thrown = 't', out_of_memory = 'm' };

std::size_t address_space_bytes() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void write_all(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1);
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

void confine(const IsolationLimits& limits, std::size_t parent_bytes, [[maybe_unused]] pid_t parent) {
  std::set_new_handler(nullptr);  // the program's own would end the child without a word
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before that was said
#endif
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTERM}) std::signal(signal, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // the parent decides
  const int null = open("/dev/null", O_RDWR);
  if (null >= 0) {
    dup2(null, STDOUT_FILENO);
    dup2(null, STDERR_FILENO);
  }
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const rlim_t bytes = parent_bytes + (rlim_t{limits.memory_mb} << 20);
  const rlimit memory{bytes, bytes};
  setrlimit(RLIMIT_AS, &memory);
}

[[noreturn]] void work_in_child(const std::function<std::string()>& work, int out) {
  // Libraries read numbers by strtod(), which a host's locale may have taught to end at a point.
  uselocale(newlocale(LC_ALL_MASK, "C", nullptr));
  Ending ending = Ending::result;
  std::string bytes;
  try {
    bytes = work();
  } catch (const std::bad_alloc&) {
    ending = Ending::out_of_memory;
  } catch (const std::exception& e) {
    ending = Ending::thrown;
    bytes = e.what();
  } catch (...) {
    ending = Ending::thrown;
    bytes = "something was thrown";
  }
  const char first = static_cast<char>(ending);
  write_all(out, &first, 1);
  write_all(out, bytes.data(), bytes.size());
  _exit(0);
}

/// Ends the child whatever happens.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ > 0) {
      kill(id_, SIGKILL);
      wait();
    }
  }
  int wait() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    return status;
  }

 private:
  pid_t id_;
};

struct FileDescriptor {
  int number = -1;
  ~FileDescriptor() {
    if (number >= 0) close(number);
  }
};

Result<std::string> received(const std::string& bytes, int status) {
  if (WIFSIGNALED(status))
    return fail(ErrorCode::third_party, "the work crashed (" + std::string(strsignal(WTERMSIG(status))) + ")");
  if (bytes.empty()) return fail(ErrorCode::third_party, "the work ended without a word");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return fail(ErrorCode::third_party, "the work ended before all was said");
  const Ending ending{bytes[0]};
  std::string rest = bytes.substr(1);
  if (ending == Ending::out_of_memory) return fail(ErrorCode::over_budget, "the work ran out of the memory allowed");
  if (ending == Ending::thrown) return fail(ErrorCode::third_party, std::move(rest));
  return rest;
}

}  // namespace

Result<std::string> run_isolated(const std::function<std::string()>& work, const IsolationLimits& limits,
                                 const Job& job, std::string_view stage) {
  if (limits.seconds <= 0) return fail(ErrorCode::over_budget, "no time was allowed");
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return fail(ErrorCode::third_party, "no pipe to be had from the system");
  FileDescriptor in{ends[0]}, out{ends[1]};
  const std::size_t parent_bytes = address_space_bytes();
  std::fflush(nullptr);
  const pid_t parent = getpid(), id = fork();
  if (id < 0) return fail(ErrorCode::third_party, "no process to be had from the system");
  if (id == 0) {
    close(in.number);
    confine(limits, parent_bytes, parent);
    work_in_child(work, out.number);
  }
  Child child(id);
  close(std::exchange(out.number, -1));

  const auto start = Clock::now();
  std::string bytes;
  std::array<char, 1 << 16> block{};
  for (;;) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (!job.report(seconds / (seconds + 5), stage)) return cancelled();
    if (seconds > limits.seconds) return fail(ErrorCode::over_budget, "the work took longer than allowed");
    pollfd waiting{in.number, POLLIN, 0};
    if (poll(&waiting, 1, 50) <= 0) continue;
    const ssize_t count = read(in.number, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
  return received(bytes, child.wait());
}

}  // namespace aplomb
