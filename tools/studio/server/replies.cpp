#include "server/replies.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

namespace aplomb::studio {

void refuse(httplib::Response& response, Status status, Ending ending, std::string_view sentence) {
  const nlohmann::ordered_json said{{"error", sentence}, {"code", static_cast<int>(ending)}};
  response.status = status;
  response.set_content(said.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), "application/json");
}

namespace {

void name_file(httplib::Response& response, std::string_view name) {
  std::string plain, coded;
  for (const char c : name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
    plain += is_plain ? c : '_';
    coded += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  response.set_header("Content-Disposition",
                      fmt::format("attachment; filename=\"{}\"; filename*=UTF-8''{}", plain, coded));
}

}  // namespace

void answer_file(httplib::Response& response, const std::string& bytes, std::string_view name, const char* type) {
  name_file(response, name);
  response.set_content(bytes, type);
}

bool answer_file(httplib::Response& response, const std::filesystem::path& file, const char* type) {
  const auto stream = std::make_shared<std::ifstream>(file, std::ios::binary | std::ios::ate);
  if (!*stream) return false;
  const auto bytes = static_cast<std::size_t>(stream->tellg());
  name_file(response, file.filename().string());
  response.set_content_provider(bytes, type, [stream](std::size_t at, std::size_t left, httplib::DataSink& sink) {
    std::array<char, 1 << 16> part;
    stream->seekg(static_cast<std::streamoff>(at));
    stream->read(part.data(), static_cast<std::streamsize>(std::min(left, part.size())));
    return stream->gcount() > 0 && sink.write(part.data(), static_cast<std::size_t>(stream->gcount()));
  });
  return true;
}

}  // namespace aplomb::studio
