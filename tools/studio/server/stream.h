#pragma once

#include <chrono>
#include <functional>
#include <string_view>

#include "server/turns.h"
#include "wire/frames.h"

namespace httplib {
class DataSink;
}

namespace aplomb::studio {

/// The answer that a page is reading, frame by frame.
class Stream {
 public:
  Stream(httplib::DataSink& sink, const Turn& turn) : sink_(sink), turn_(turn) {}

  void frame(FrameKind kind, std::string_view payload);
  void json(std::string_view message) { frame(FrameKind::json, message); }
  void end() { frame(FrameKind::end, {}); }

  /// Whether nobody wants the rest: it was cancelled, or the page went away.
  bool is_over();
  /// Says that there is nothing new, where nothing was said for a second.
  void stay_alive();

 private:
  httplib::DataSink& sink_;
  const Turn& turn_;
  bool is_broken_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace aplomb::studio
