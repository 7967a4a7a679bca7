#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

namespace aplomb::studio {

/// What the server asks of the solver; as JSON on the wire.
struct SolverRequest {
  std::uint32_t number = 0;  ///< counted up by the server
  std::string what;          ///< place, check, preview, validate or result
  std::string folder;        ///< that relative paths start from
  std::string job;           ///< as parse_job() reads it
  double wish = 0;           ///< of a preview, to be said again
  std::string file{};        ///< result: the mesh that was written
  std::string dense{};       ///< result: the volume of denser infill, where there may be one
  std::string stl{};         ///< result: where the mesh is to be written as STL
};

std::string to_json(const SolverRequest& request);
/// Nothing where it is none.
std::optional<SolverRequest> parse_request(const std::string& text);

/// What has come for the solver. A thread of its own reads, so that a word to cancel is heard during the work; where
/// the other side closes, the process ends.
class Inbox {
 public:
  explicit Inbox(int file);
  /// Waits for the next request.
  SolverRequest next();
  /// Whether something waits that is no preview.
  bool has_other_than_preview();
  bool is_cancelled(const SolverRequest& request) const { return request.number <= cancelled_.load(); }

 private:
  void listen(int file);

  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<SolverRequest> waiting_;
  std::atomic<std::uint32_t> cancelled_{0};  // this one, and all before
};

}  // namespace aplomb::studio
