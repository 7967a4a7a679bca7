#include "server/ask.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace aplomb::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr int most_levels = 100;
constexpr std::array<const char*, 10> file_keys{"aplomb_job", "model",   "output", "report",  "dump",
                                                "html",       "picture", "plugs",  "profile", "modifier"};

/// Of a body that does not nest deeper than what is called by itself can bear.
Json parsed(const std::string& text) {
  return Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
    if (depth > most_levels) throw std::length_error("it nests too deep");
    return true;
  });
}

std::string text_at(const Json& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_string() ? at->get<std::string>() : std::string();
}

int number_at(const Json& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_number_integer() ? at->get<int>() : 0;
}

}  // namespace

Result<Ask> parse_ask(const std::string& body) {
  const auto refuse = [](std::string why) { return fail(ErrorCode::invalid_option, std::move(why)); };
  Json json;
  try {
    json = parsed(body);
  } catch (const std::exception&) {
    return refuse("the request is no JSON");
  }
  if (!json.is_object()) return refuse("the request is no JSON object");
  Ask ask{.of = text_at(json, "of"), .what = text_at(json, "what"), .name = text_at(json, "name")};
  ask.model = number_at(json, "model");
  ask.profile = number_at(json, "profile");
  if (json.contains("wish") && json["wish"].is_number()) ask.wish = json["wish"].get<double>();
  const Json job = json.value("job", Json::object());
  if (!job.is_object()) return refuse("the job is no object");
  for (const char* key : file_keys)
    if (job.contains(key)) return refuse(fmt::format("a job in the studio has no '{}': it names no files", key));
  ask.job = job.dump(-1, ' ', false, Json::error_handler_t::replace);
  return ask;
}

bool same_work(const Ask& a, const Ask& b) {
  const auto unordered = [](const std::string& job) { return nlohmann::json::parse(job, nullptr, false); };
  return a.model == b.model && a.profile == b.profile && unordered(a.job) == unordered(b.job);
}

std::string without_files(const std::string& text) {
  Json job = Json::parse(text);
  for (const char* key : file_keys) job.erase(key);
  return job.dump();
}

}  // namespace aplomb::studio
