#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "aplomb/core/error.h"

/// What every fuzz target asks of every answer; a broken promise aborts, which the fuzzer takes for a crash.
namespace aplomb::fuzz {

inline void promise(bool kept, const std::string& broken) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", broken.c_str());
  std::abort();
}

/// One line for people: short, without control characters, and of a kind that a reader may give.
inline void check_error(const Error& error) {
  promise(!error.message.empty() && error.message.size() < 1000, "a message of fitting length: " + error.message);
  for (const char c : error.message)
    promise(static_cast<unsigned char>(c) >= 32 && c != 127, "a message without control characters: " + error.message);
  promise(error.code != ErrorCode::internal && error.code != ErrorCode::third_party,
          "no fault of ours: " + error.message);
}

/// An error that tells what to do about it behind its semicolon.
inline void check_remedy(const Error& error) {
  check_error(error);
  promise(error.message.find(';') != std::string::npos, "a remedy: " + error.message);
}

}  // namespace aplomb::fuzz
