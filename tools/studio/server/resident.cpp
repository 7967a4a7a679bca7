#include "server/resident.h"

#include <signal.h>
#include <sys/wait.h>

#include "aplomb/ending.h"
#include "wire/messages.h"

namespace aplomb::studio {
namespace {

constexpr auto patience = std::chrono::seconds(5);  // with a child that was told to cancel

}  // namespace

bool Resident::send(const SolverRequest& request, Stream& stream) {
  const std::string text = to_json(request);
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (child_ && child_->ended(0)) child_.reset();  // it died while nobody looked
    if (!child_) {
      auto child = Child::start({program_.string(), "--solver"}, "/");
      if (!child) {
        stream.json(error_message(child.error()));
        return false;
      }
      child_.emplace(std::move(*child));
      frames_.emplace(child_->output());
    }
    if (write_frame(child_->input(), FrameKind::json, text)) return true;
  }
  stream.json(error_message(static_cast<int>(Ending::internal), "the solver does not start"));
  return false;
}

bool Resident::tell_of_death(Stream& stream) {
  const std::string talk = child_->talk(0);
  const auto status = child_->ended(500);
  const bool exited = status && WIFEXITED(*status);
  stream.json(error_message(exited ? WEXITSTATUS(*status) : static_cast<int>(Ending::internal),
                            last_words(talk, status.value_or(SIGKILL))));
  child_.reset();
  return false;
}

bool Resident::answer(SolverRequest request, Stream& stream) {
  request.number = ++last_number_;
  if (!send(request, stream)) return false;
  bool went_well = true;
  std::optional<std::chrono::steady_clock::time_point> told_to_cancel;
  for (Frame frame;;) {
    const auto got = frames_->read(frame, 10);
    if (!told_to_cancel && stream.is_over()) {
      told_to_cancel = std::chrono::steady_clock::now();
      write_frame(child_->input(), FrameKind::cancel, number_payload(request.number));
    }
    if (got == FrameReader::Got::closed) return tell_of_death(stream);
    if (got == FrameReader::Got::frame && frame.kind == FrameKind::end) break;
    if (got == FrameReader::Got::frame && !told_to_cancel) {
      went_well = went_well && !(frame.kind == FrameKind::json && is_error(frame.payload));
      stream.frame(frame.kind, frame.payload);
    }
    stream.stay_alive();
    if (told_to_cancel && std::chrono::steady_clock::now() - *told_to_cancel > patience) {
      child_.reset();
      break;
    }
  }
  if (told_to_cancel) stream.json(cancelled_message());
  return went_well && !told_to_cancel;
}

}  // namespace aplomb::studio
