#include "server/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <linux/close_range.h>
#include <sys/prctl.h>
#endif

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>

namespace aplomb::studio {
namespace {

/// A pipe whose ends no child inherits.
struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) ends = {-1, -1};
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take(std::size_t end) { return std::exchange(ends[end], -1); }
};

/// Between fork and exec: calls only what is async-signal-safe.
[[noreturn]] void become(char* const* words, const char* folder, const std::array<int, 3>& files, pid_t parent) {
  setpgid(0, 0);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
#endif
  for (int file = 0; file < 3; ++file) dup2(files[static_cast<std::size_t>(file)], file);
#ifdef __linux__
  close_range(3, ~0U, 0);
#endif
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (chdir(folder) == 0) execv(words[0], words);
  _exit(127);
}

}  // namespace

Result<Child> Child::start(const std::vector<std::string>& command, const std::filesystem::path& folder) {
  Pipe in, out, err;
  for (const Pipe* pipe : {&in, &out, &err})
    if (pipe->ends[0] < 0) return fail(ErrorCode::file_system, "no pipe can be made for a child process");
  std::vector<char*> words;
  words.reserve(command.size() + 1);
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));  // as exec() wants it
  words.push_back(nullptr);
  const pid_t parent = getpid(), id = fork();
  if (id == 0) become(words.data(), folder.c_str(), {in.ends[0], out.ends[1], err.ends[1]}, parent);
  if (id < 0) return fail(ErrorCode::file_system, fmt::format("no child process can be started: {}", strerror(errno)));
  setpgid(id, id);  // whichever of the two comes first
  Child child;
  child.id_ = id;
  child.input_ = in.take(1);
  child.output_ = out.take(0);
  child.errors_ = err.take(0);
  fcntl(child.errors_, F_SETFL, O_NONBLOCK);
  return child;
}

void Child::swap(Child& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(status_, other.status_);
  std::swap(input_, other.input_);
  std::swap(output_, other.output_);
  std::swap(errors_, other.errors_);
}

Child::~Child() {
  kill();
  for (const int file : {input_, output_, errors_})
    if (file >= 0) close(file);
}

std::string Child::talk(int wait_ms) {
  std::string said;
  pollfd waiting{errors_, POLLIN, 0};
  poll(&waiting, 1, wait_ms);
  std::array<char, 4096> part{};
  for (ssize_t count = 0; (count = read(errors_, part.data(), part.size())) > 0;)
    said.append(part.data(), static_cast<std::size_t>(count));
  return said;
}

void Child::interrupt() const {
  if (id_ > 0 && !status_) ::kill(id_, SIGINT);
}

void Child::kill() {
  if (id_ <= 0) return;
  ::kill(-id_, SIGKILL);  // its own children, too
  while (!status_) ended(1000);
}

std::optional<int> Child::ended(int wait_ms) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(wait_ms);
  while (id_ > 0 && !status_) {
    int status = 0;
    if (waitpid(id_, &status, WNOHANG) == id_) status_ = status;
    else if (std::chrono::steady_clock::now() >= until) break;
    else std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return status_;
}

std::string last_words(const std::string& talk, int status) {
  constexpr std::string_view name = "aplomb: ";
  if (const auto at = talk.rfind(name);
      WIFEXITED(status) && at != std::string::npos && (at == 0 || talk[at - 1] == '\n'))
    return talk.substr(at + name.size(), talk.find('\n', at) - at - name.size());
  if (WIFSIGNALED(status))
    return fmt::format("the solver was ended by signal {} ({}); the next try starts another", WTERMSIG(status),
                       strsignal(WTERMSIG(status)));
  return fmt::format("the solver ended with exit code {}; the next try starts another", WEXITSTATUS(status));
}

}  // namespace aplomb::studio
