#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "aplomb/mesh/triangle_mesh.h"

// The frames of README.md's protocol: between page and server, and between server and solver.

namespace aplomb::studio {

enum class FrameKind : std::uint32_t {
  end = 0,
  json = 1,
  mesh = 2,
  positions = 3,
  cancel = 16,  ///< to the solver alone: u32, the number of the request
};

struct Frame {
  FrameKind kind = FrameKind::end;
  std::string payload;
};

/// What stands before a payload of so many bytes.
std::string header_of(FrameKind kind, std::size_t bytes);

std::string mesh_payload(std::string_view name, const TriangleMesh& mesh);
std::string positions_payload(std::span<const Vec3> vertices);
std::string number_payload(std::uint32_t number);
/// 0 where the payload is no number.
std::uint32_t number_of(std::string_view payload);

/// Takes frames from a file descriptor, which it does not close.
class FrameReader {
 public:
  enum class Got { frame, nothing, closed };

  explicit FrameReader(int file) : file_(file) {}

  /// Waits up to wait_ms (-1: as long as it takes) for more. \return nothing when there is no whole frame yet; closed
  /// at the end of the file, or where what comes is no frame.
  Got read(Frame& frame, int wait_ms);

 private:
  int file_;
  std::string header_;
  Frame coming_;
  std::size_t filled_ = 0;  // of the payload
};

/// Writes all of it, however long the other side takes. \return false where the other side is gone.
bool write_all(int file, std::string_view bytes);
bool write_frame(int file, FrameKind kind, std::string_view payload);

}  // namespace aplomb::studio
