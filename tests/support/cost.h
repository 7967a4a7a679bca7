#pragma once

#include <cstddef>
#include <functional>

/// What a piece of work costs, measured in a process of its own.
namespace aplomb::test {

struct Cost {
  bool ended = false;          ///< false: it crashed
  double seconds = 0;          ///< of CPU
  std::size_t peak_bytes = 0;  ///< of memory, on top of what the process held before
};

/// What takes over 3 s is done up to five times, of which the fastest counts: CPU that others slow down, through
/// caches and memory, only takes longer.
Cost cost_of(const std::function<void()>& work);

/// Of the same work: the fewer seconds, and the more memory.
Cost least_of(const Cost& a, const Cost& b);

/// The least seconds of up to `times` that are measured, until they are below `most_s`.
double least_seconds(const std::function<double()>& measured, double most_s, int times = 3);

/// Whether memory and time are those of a build for use: sanitizers take several times of both.
constexpr bool is_sanitized() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
  return true;
#endif
#endif
  return false;
}

}  // namespace aplomb::test
