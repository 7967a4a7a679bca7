#pragma once

// Included before every file of this target: what runs in parallel there runs on plain std::threads, all of whose
// synchronisation ThreadSanitizer sees. In libtbb, which is not instrumented, it would see none and report everything.

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <atomic>
#include <cstddef>
#include <thread>
#include <type_traits>
#include <vector>

namespace tbb {

inline constexpr std::size_t plain_threads = 4;
inline thread_local bool is_plain_thread = false;

/// run(0) to run(count - 1), each once, on threads of their own; in a thread of this kind one after the other.
template <class Run>
void run_on_threads(std::size_t count, const Run& run) {
  if (is_plain_thread || count < 2) {
    for (std::size_t n = 0; n < count; ++n) run(n);
    return;
  }
  std::atomic<std::size_t> next{0};
  const auto mine = [&] {
    return next.fetch_add(1, std::memory_order_relaxed);
  };  // orders nothing else: it would hide races
  const auto work = [&] {
    is_plain_thread = true;
    for (std::size_t n = mine(); n < count; n = mine()) run(n);
  };
  std::vector<std::thread> threads;
  for (std::size_t n = 0; n < plain_threads; ++n) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
}

/// The parts of a range that are not to be divided further.
template <class Range>
std::vector<Range> parts_of(const Range& whole) {
  std::vector<Range> parts{whole};
  for (std::size_t n = 0; n < parts.size();) {
    if (parts.size() > 64 || !parts[n].is_divisible()) ++n;
    else {
      Range rest(parts[n], tbb::split());
      parts.push_back(rest);
    }
  }
  return parts;
}

template <class Range, class Body, class... Partitioner>
requires requires(const Range& range) { range.is_divisible(); }
void plain_parallel_for(const Range& range, const Body& body, Partitioner&&...) {
  const std::vector<Range> parts = parts_of(range);
  run_on_threads(parts.size(), [&](std::size_t n) {
    Range part = parts[n];
    body(part);
  });
}

template <class Index, class Body>
requires std::is_integral_v<Index>
void plain_parallel_for(Index first, Index last, const Body& body) {
  if (first < last) run_on_threads(std::size_t(last - first), [&](std::size_t n) { body(Index(first + Index(n))); });
}

template <class Range, class Value, class Body, class Reduction>
Value plain_parallel_reduce(const Range& range, const Value& identity, const Body& body, const Reduction& reduction) {
  const std::vector<Range> parts = parts_of(range);
  std::vector<Value> values(parts.size(), identity);
  run_on_threads(parts.size(), [&](std::size_t n) {
    Range part = parts[n];
    values[n] = body(part, identity);
  });
  Value all = identity;
  for (const Value& value : values) all = reduction(all, value);
  return all;
}

/// OpenVDB's: a body that is split and joined; here it is not.
template <class Range, class Body>
void plain_parallel_reduce(const Range& range, Body& body) {
  body(range);
}

}  // namespace tbb

#define parallel_for plain_parallel_for
#define parallel_reduce plain_parallel_reduce
