#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>

namespace aplomb::studio {

/// What a stream is for.
enum class Errand { place, check, preview, validate, stand };

/// One wish to have the solver.
struct Turn {
  explicit Turn(Errand what) : errand(what) {}
  Errand errand;
  std::atomic<bool> is_cancelled{false};
};

/// Who works, and who waits: one solver at a time, in the order in which they came. A newer wish of a kind cancels the
/// older ones; what runs whole cancels previews.
class Turns {
 public:
  std::shared_ptr<Turn> ask(Errand errand);
  /// Waits for up to wait_ms. \return whether it is this one's turn.
  bool is_up(const Turn& turn, int wait_ms);
  void leave(const Turn& turn);
  /// Everyone, and who comes later, too, where `for_good`.
  void cancel_all(bool for_good);

 private:
  std::mutex mutex_;
  std::condition_variable moved_;
  std::deque<std::shared_ptr<Turn>> waiting_;  // the first works
  bool is_closed_ = false;
};

}  // namespace aplomb::studio
