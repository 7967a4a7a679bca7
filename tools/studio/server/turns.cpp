#include "server/turns.h"

#include <algorithm>
#include <chrono>

namespace aplomb::studio {

std::shared_ptr<Turn> Turns::ask(Errand errand) {
  const bool runs_whole = errand == Errand::stand || errand == Errand::validate;
  const std::lock_guard lock(mutex_);
  for (const auto& other : waiting_)
    if (other->errand == errand || (runs_whole && other->errand == Errand::preview)) other->is_cancelled = true;
  waiting_.push_back(std::make_shared<Turn>(errand));
  waiting_.back()->is_cancelled = is_closed_;
  return waiting_.back();
}

bool Turns::is_up(const Turn& turn, int wait_ms) {
  std::unique_lock lock(mutex_);
  return moved_.wait_for(lock, std::chrono::milliseconds(wait_ms),
                         [&] { return !waiting_.empty() && waiting_.front().get() == &turn; });
}

void Turns::leave(const Turn& turn) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const auto& other) { return other.get() == &turn; });
  moved_.notify_all();
}

void Turns::cancel_all(bool for_good) {
  const std::lock_guard lock(mutex_);
  is_closed_ = is_closed_ || for_good;
  for (const auto& turn : waiting_) turn->is_cancelled = true;
}

}  // namespace aplomb::studio
