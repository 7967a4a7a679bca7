#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <string_view>

#include "support/cost.h"

namespace aplomb::test {

constexpr std::size_t megabyte = std::size_t{1} << 20;

inline std::string repeated(std::string_view text, std::size_t count) {
  std::string all;
  all.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) all.append(text);
  return all;
}

/// Asks that work in a process of its own ended in time; of memory, only what a build for use takes is asked.
inline void expect_within(const Cost& cost, std::size_t peak_bytes, std::string_view what) {
  constexpr int kSlower = 5;  // what sanitizers make of reading, at the most
  std::cout << "  " << what << ": " << cost.seconds << " s, " << (cost.peak_bytes >> 20) << " MB\n";
  EXPECT_TRUE(cost.ended) << what;
  EXPECT_LT(cost.seconds, 10 * (is_sanitized() ? kSlower : 1)) << what;
  if (!is_sanitized()) {
    EXPECT_LT(cost.peak_bytes, peak_bytes) << what;
  }
}

}  // namespace aplomb::test
