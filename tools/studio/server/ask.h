#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "aplomb/core/error.h"

namespace aplomb::studio {

/// The body of a request, as far as all of them are alike.
struct Ask {
  int model = 0;
  int profile = 0;     ///< 0: none
  std::string job{};   ///< JSON, its keys in the order in which they came
  double wish = 0;     ///< of a preview
  std::string of{};    ///< of a judgement: "model" or "result"
  std::string what{};  ///< of what is taken away
  std::string name{};  ///< of a fixture, or a ticket
};

/// \return invalid_option where it is no JSON object, or names files.
Result<Ask> parse_ask(const std::string& body);

/// Whether both are of the same model, profile and job, whatever the order of its keys.
bool same_work(const Ask& a, const Ask& b);

/// The job of a file without the keys that name files. \pre `text` is a job.
std::string without_files(const std::string& text);

}  // namespace aplomb::studio
