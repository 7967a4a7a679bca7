#pragma once

#include <string>
#include <string_view>

#include "aplomb/core/error.h"

// The JSON messages that server and solver both say.

namespace aplomb::studio {

/// {"type": "error", "code": 2, "message": "..."}
std::string error_message(int code, std::string_view sentence);
std::string error_message(const Error& error);

/// Whether a message of the solver or the server is one of the two above.
bool is_error(std::string_view message);

std::string cancelled_message();
std::string alive_message();
std::string written_message();
std::string progress_message(double fraction, std::string_view stage);

/// {"type": TYPE, KEY: what `json` holds, "message": SENTENCE}; without a sentence no key `message`. \pre json is one.
std::string wrapped_message(std::string_view type, std::string_view key, std::string_view json,
                            std::string_view sentence = {});

}  // namespace aplomb::studio
