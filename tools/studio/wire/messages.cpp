#include "wire/messages.h"

#include <nlohmann/json.hpp>

#include "aplomb/ending.h"

namespace aplomb::studio {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string error_message(int code, std::string_view sentence) {
  return text_of({{"type", "error"}, {"code", code}, {"message", sentence}});
}

std::string error_message(const Error& error) {
  if (error.code == ErrorCode::cancelled) return cancelled_message();
  return error_message(static_cast<int>(ending_of(error)), error.message);
}

bool is_error(std::string_view message) { return message.starts_with(R"({"type":"error")"); }

std::string cancelled_message() { return R"({"type":"cancelled"})"; }

std::string alive_message() { return R"({"type":"alive"})"; }

std::string written_message() { return R"({"type":"written"})"; }

std::string progress_message(double fraction, std::string_view stage) {
  return text_of({{"type", "progress"}, {"fraction", fraction}, {"stage", stage}});
}

std::string wrapped_message(std::string_view type, std::string_view key, std::string_view json,
                            std::string_view sentence) {
  Json message{{"type", type}, {std::string(key), Json::parse(json)}};
  if (!sentence.empty()) message["message"] = sentence;
  return text_of(message);
}

}  // namespace aplomb::studio
