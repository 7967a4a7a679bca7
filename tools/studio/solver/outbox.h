#pragma once

#include <chrono>
#include <span>
#include <string_view>

#include "aplomb/core/job.h"
#include "aplomb/mesh/triangle_mesh.h"
#include "solver/inbox.h"

namespace aplomb::studio {

/// Where the answers to one request go.
class Outbox {
 public:
  Outbox(int file, const Inbox& inbox, const SolverRequest& request) : file_(file), inbox_(inbox), request_(request) {}

  void json(std::string_view message);
  void mesh(std::string_view name, const TriangleMesh& mesh);
  void positions(std::span<const Vec3> vertices);
  void end();

  bool is_cancelled() const { return inbox_.is_cancelled(request_); }
  /// Ends when the request is cancelled; tells of its progress where that is asked for. \pre this outlives it.
  Job work(bool tells_progress);

 private:
  int file_;
  const Inbox& inbox_;
  const SolverRequest& request_;
  std::chrono::steady_clock::time_point told_{};
};

}  // namespace aplomb::studio
