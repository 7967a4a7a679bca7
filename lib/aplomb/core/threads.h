#pragma once

#include <memory>

namespace aplomb {

/// While it lives, at most this many threads work for the library; 0 or fewer: one per core. Results do not depend on
/// it.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace aplomb
