#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "server/child.h"
#include "server/stream.h"
#include "solver/inbox.h"

namespace aplomb::studio {

/// The child that holds the solid. Its death is a message to whom it was answering; where nobody was waiting, nobody
/// hears of it. One caller at a time: see Turns.
class Resident {
 public:
  explicit Resident(std::filesystem::path program) : program_(std::move(program)) {}

  /// Has a request answered; all frames but the last go to the stream. Starts the child where there is none.
  /// \return whether it was answered to the end, and without an error.
  bool answer(SolverRequest request, Stream& stream);

 private:
  enum class Heard { nothing, answer, error };

  bool start(Stream& stream);
  Heard converse(const SolverRequest& request, Stream& stream);
  bool tell_of_death(Stream& stream);
  /// What it says on standard error: the pipe must not fill up, and its last words may be asked for.
  void listen();

  std::filesystem::path program_;
  std::optional<Child> child_;
  std::optional<FrameReader> frames_;
  std::string talk_;
  std::uint32_t last_number_ = 0;
};

}  // namespace aplomb::studio
