#pragma once

#include <functional>
#include <string_view>
#include <utility>

namespace aplomb {

/// Progress out, cancel in. A stage calls report() at least every 100 ms from the calling thread and ends with
/// ErrorCode::cancelled when it returns false.
class Job {
 public:
  /// Called with the share done, in [0, 1], and the stage's name; false asks to stop.
  using Listener = std::function<bool(double fraction, std::string_view stage)>;

  Job() = default;
  explicit Job(Listener listener) : listener_(std::move(listener)) {}

  /// False: the caller wants to stop. `fraction` is of this job (or part of one).
  bool report(double fraction, std::string_view stage) const {
    return !listener_ || listener_(from_ + (to_ - from_) * fraction, stage);
  }

  /// The same job, of which a stage sees [from, to] as its own [0, 1].
  Job part(double from, double to) const {
    Job inner = *this;
    inner.from_ = from_ + (to_ - from_) * from;
    inner.to_ = from_ + (to_ - from_) * to;
    return inner;
  }

 private:
  Listener listener_;
  double from_ = 0;
  double to_ = 1;
};

}  // namespace aplomb
