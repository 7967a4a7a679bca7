#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "aplomb/core/error.h"
#include "support/refusal.h"

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

/// A refusal of a mesh file, as tests ask of it, too.
inline void check_refusal(const Error& error, std::string_view file_name) {
  check_error(error);
  const std::string lack = test::lack_of_refusal(error.message, file_name);
  promise(lack.empty(), lack + ": " + error.message);
}

/// The same of an option, whose range is remedy enough: "wall_mm is -1 but must be a number above 0".
inline void check_remedy_or_range(const Error& error) {
  if (error.message.find(" must be ") == std::string::npos && error.message.find(" lacks '") == std::string::npos)
    return check_remedy(error);
  check_error(error);
}

}  // namespace aplomb::fuzz
