#pragma once

#include <string>
#include <tl/expected.hpp>

namespace aplomb {

/// Why a stage could not give its result. "It ran, but this cannot stand" is not an error: it is an outcome in the
/// value.
enum class ErrorCode {
  invalid_option,  ///< an option or argument outside its range
  unusable_input,  ///< the file or mesh cannot be used; the message names the place and the remedy
  cancelled,       ///< the caller's Job said so
  over_budget,     ///< the memory or time allowed would not do; nothing was allocated
  third_party,     ///< a library failed on what it was given
  file_system,     ///< a file could not be read or written
  internal,        ///< a promise of our own was broken
};

struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string message;  ///< one sentence for people: what, where in the file or which option, and the remedy
};

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

inline tl::unexpected<Error> cancelled() { return fail(ErrorCode::cancelled, "cancelled"); }

}  // namespace aplomb
