#include "solver/inbox.h"

#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "wire/frames.h"

namespace aplomb::studio {

using Json = nlohmann::json;

std::string to_json(const SolverRequest& r) {
  const Json json{{"number", r.number}, {"what", r.what}, {"folder", r.folder}, {"job", r.job},
                  {"wish", r.wish},     {"file", r.file}, {"dense", r.dense},   {"stl", r.stl}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<SolverRequest> parse_request(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  return SolverRequest{json.value("number", 0U), json.value("what", ""),  json.value("folder", ""),
                       json.value("job", ""),    json.value("wish", 0.0), json.value("file", ""),
                       json.value("dense", ""),  json.value("stl", "")};
}

Inbox::Inbox(int file) { std::thread(&Inbox::listen, this, file).detach(); }

void Inbox::listen(int file) {
  FrameReader reader(file);
  Frame frame;
  while (reader.read(frame, -1) != FrameReader::Got::closed) {
    if (frame.kind == FrameKind::cancel) cancelled_ = number_of(frame.payload);
    if (frame.kind != FrameKind::json) continue;
    auto request = parse_request(std::exchange(frame, {}).payload);
    if (!request) continue;
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(*request));
    came_.notify_one();
  }
  _exit(0);  // nobody is left to answer
}

SolverRequest Inbox::next() {
  std::unique_lock lock(mutex_);
  came_.wait(lock, [this] { return !waiting_.empty(); });
  SolverRequest request = std::move(waiting_.front());
  waiting_.pop_front();
  return request;
}

bool Inbox::has_other_than_preview() {
  const std::lock_guard lock(mutex_);
  return !waiting_.empty() && waiting_.front().what != "preview";
}

}  // namespace aplomb::studio
