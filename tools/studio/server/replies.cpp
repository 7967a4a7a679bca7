#include "server/replies.h"

#include <fmt/format.h>
#include <httplib.h>

#include <cctype>
#include <nlohmann/json.hpp>

namespace aplomb::studio {

void refuse(httplib::Response& response, Status status, Ending ending, std::string_view sentence) {
  const nlohmann::ordered_json said{{"error", sentence}, {"code", static_cast<int>(ending)}};
  response.status = status;
  response.set_content(said.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), "application/json");
}

void answer_file(httplib::Response& response, const std::string& bytes, std::string_view name, const char* type) {
  std::string plain, coded;
  for (const char c : name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
    plain += is_plain ? c : '_';
    coded += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  response.set_header("Content-Disposition",
                      fmt::format("attachment; filename=\"{}\"; filename*=UTF-8''{}", plain, coded));
  response.set_content(bytes, type);
}

}  // namespace aplomb::studio
