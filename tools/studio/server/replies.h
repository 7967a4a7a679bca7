#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "aplomb/ending.h"

namespace httplib {
struct Response;
}

namespace aplomb::studio {

/// HTTP statuses of refusals.
enum Status {
  no_content = 204,
  bad_request = 400,
  unauthorized = 401,
  not_found = 404,
  conflict = 409,
  too_large = 413,
  broken = 500
};

/// {"error": SENTENCE, "code": the program's exit code}
void refuse(httplib::Response& response, Status status, Ending ending, std::string_view sentence);

/// A file to be kept under `name`, which may be any text.
void answer_file(httplib::Response& response, const std::string& bytes, std::string_view name, const char* type);
/// Of a file on disk, which may be removed while it is sent. \return whether it could be opened.
bool answer_file(httplib::Response& response, const std::filesystem::path& file, const char* type);

}  // namespace aplomb::studio
