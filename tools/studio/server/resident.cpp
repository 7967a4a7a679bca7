#include "server/resident.h"

#include <signal.h>
#include <sys/wait.h>

#include "aplomb/ending.h"
#include "wire/messages.h"

namespace aplomb::studio {
namespace {

constexpr auto patience = std::chrono::seconds(5);        // with a child that was told to cancel
constexpr auto at_once = std::chrono::milliseconds(200);  // who dies so soon was dying when it was asked
constexpr std::size_t most_talk_bytes = 4096;

}  // namespace

bool Resident::start(Stream& stream) {
  auto child = Child::start({program_.string(), "--solver"}, "/");
  if (!child) {
    stream.json(error_message(child.error()));
    return false;
  }
  child_.emplace(std::move(*child));
  frames_.emplace(child_->output());
  talk_.clear();
  return true;
}

void Resident::listen() {
  talk_ += child_->talk(0);
  if (talk_.size() > most_talk_bytes) talk_.erase(0, talk_.size() - most_talk_bytes);
}

bool Resident::tell_of_death(Stream& stream) {
  listen();
  const auto status = child_->ended(500);
  const bool exited = status && WIFEXITED(*status);
  stream.json(error_message(exited ? WEXITSTATUS(*status) : static_cast<int>(Ending::internal),
                            last_words(talk_, status.value_or(SIGKILL))));
  child_.reset();
  return false;
}

bool Resident::answer(SolverRequest request, Stream& stream) {
  for (bool was_there = child_.has_value();; was_there = false) {
    if (!child_ && !start(stream)) return false;
    request.number = ++last_number_;
    const Heard heard = converse(request, stream);
    if (heard != Heard::nothing) return heard == Heard::answer;
    if (!was_there) return tell_of_death(stream);
    child_.reset();  // it had died while nobody looked
  }
}

Resident::Heard Resident::converse(const SolverRequest& request, Stream& stream) {
  const auto asked = std::chrono::steady_clock::now();
  if (!write_frame(child_->input(), FrameKind::json, to_json(request))) return Heard::nothing;
  Heard heard = Heard::nothing;
  std::optional<std::chrono::steady_clock::time_point> told_to_cancel;
  for (Frame frame;;) {
    const auto got = frames_->read(frame, 10);
    listen();
    const auto now = std::chrono::steady_clock::now();
    if (!told_to_cancel && stream.is_over()) {
      told_to_cancel = now;
      write_frame(child_->input(), FrameKind::cancel, number_payload(request.number));
    }
    if (got == FrameReader::Got::closed) {
      if (heard == Heard::nothing && now - asked < at_once) return heard;
      tell_of_death(stream);
      return Heard::error;
    }
    if (got == FrameReader::Got::frame && frame.kind == FrameKind::end) break;
    if (got == FrameReader::Got::frame && !told_to_cancel) {
      if (heard == Heard::nothing) heard = Heard::answer;
      if (frame.kind == FrameKind::json && is_error(frame.payload)) heard = Heard::error;
      stream.frame(frame.kind, frame.payload);
    }
    stream.stay_alive();
    if (told_to_cancel && now - *told_to_cancel > patience) {
      child_.reset();
      break;
    }
  }
  if (!told_to_cancel) return heard == Heard::nothing ? Heard::answer : heard;
  stream.json(cancelled_message());
  return Heard::error;
}

}  // namespace aplomb::studio
