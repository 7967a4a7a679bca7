#include "server/stream.h"

#include <httplib.h>

#include "wire/messages.h"

namespace aplomb::studio {

void Stream::frame(FrameKind kind, std::string_view payload) {
  constexpr std::size_t piece = std::size_t{1} << 18;  // the library copies what it sends
  const std::string header = header_of(kind, payload.size());
  is_broken_ = is_broken_ || !sink_.write(header.data(), header.size());
  for (std::size_t at = 0; at < payload.size() && !is_broken_; at += piece) {
    const std::string_view part = payload.substr(at, piece);
    is_broken_ = !sink_.write(part.data(), part.size());
  }
  last_ = std::chrono::steady_clock::now();
}

bool Stream::is_over() {
  is_broken_ = is_broken_ || !sink_.is_writable();
  return is_broken_ || turn_.is_cancelled.load();
}

void Stream::stay_alive() {
  if (std::chrono::steady_clock::now() - last_ >= std::chrono::seconds(1)) json(alive_message());
}

}  // namespace aplomb::studio
