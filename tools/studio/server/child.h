#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "aplomb/core/error.h"

namespace aplomb::studio {

/// A program that runs as a child, in a process group of its own; it is killed with all its group when this goes, or
/// when the server dies.
class Child {
 public:
  /// \return file_system when it cannot be started.
  static Result<Child> start(const std::vector<std::string>& command, const std::filesystem::path& folder);

  Child(Child&& other) noexcept { swap(other); }
  Child& operator=(Child&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Child();

  int input() const { return input_; }    ///< write here what it reads
  int output() const { return output_; }  ///< read here what it writes
  /// What it has written to standard error since the last call; waits for up to wait_ms for some.
  std::string talk(int wait_ms);

  void interrupt() const;  ///< Ctrl-C
  void kill();
  /// Its status as waitpid() gives it, once it has ended; looks for up to wait_ms.
  std::optional<int> ended(int wait_ms);

 private:
  Child() = default;
  void swap(Child& other) noexcept;

  pid_t id_ = 0;
  std::optional<int> status_;
  int input_ = -1, output_ = -1, errors_ = -1;
};

/// Why a child is no more, as a sentence: what it said last on standard error, or the signal that ended it.
std::string last_words(const std::string& talk, int status);

}  // namespace aplomb::studio
