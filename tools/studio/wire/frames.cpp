#include "wire/frames.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <vector>

namespace aplomb::studio {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are little-endian: swap bytes here");

constexpr std::size_t header_bytes = 8;
constexpr std::size_t most_payload_bytes = std::size_t{1} << 30;

void append(std::string& text, const void* data, std::size_t bytes) {
  text.append(static_cast<const char*>(data), bytes);
}

void append_number(std::string& text, std::size_t number) {
  const auto small = static_cast<std::uint32_t>(number);
  append(text, &small, sizeof small);
}

void append_points(std::string& text, std::span<const Vec3> points) {
  std::vector<float> floats;
  floats.reserve(3 * points.size());
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) floats.push_back(static_cast<float>(p[axis]));
  append(text, floats.data(), floats.size() * sizeof(float));
}

}  // namespace

std::string header_of(FrameKind kind, std::size_t bytes) {
  std::string header;
  append_number(header, bytes);
  append_number(header, static_cast<std::size_t>(kind));
  return header;
}

std::string mesh_payload(std::string_view name, const TriangleMesh& mesh) {
  std::string payload;
  payload.reserve(32 + name.size() + 12 * (mesh.vertices.size() + mesh.triangles.size()));
  append_number(payload, name.size());
  payload += name;
  payload.resize((payload.size() + 3) / 4 * 4, '\0');
  append_number(payload, mesh.vertices.size());
  append_number(payload, mesh.triangles.size());
  append_points(payload, mesh.vertices);
  append(payload, mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
  return payload;
}

std::string positions_payload(std::span<const Vec3> vertices) {
  std::string payload;
  payload.reserve(4 + 12 * vertices.size());
  append_number(payload, vertices.size());
  append_points(payload, vertices);
  return payload;
}

std::string number_payload(std::uint32_t number) {
  std::string payload;
  append_number(payload, number);
  return payload;
}

std::uint32_t number_of(std::string_view payload) {
  std::uint32_t number = 0;
  if (payload.size() == sizeof number) std::memcpy(&number, payload.data(), sizeof number);
  return number;
}

FrameReader::Got FrameReader::read(Frame& frame, int wait_ms) {
  for (;;) {
    const bool in_header = header_.size() < header_bytes;
    if (!in_header && filled_ == coming_.payload.size()) {
      frame = std::move(coming_);
      coming_ = {};
      header_.clear();
      filled_ = 0;
      return Got::frame;
    }
    pollfd waiting{file_, POLLIN, 0};
    const int ready = poll(&waiting, 1, wait_ms);
    if (ready == 0 || (ready < 0 && errno == EINTR)) return Got::nothing;
    std::array<char, header_bytes> start{};
    char* to = in_header ? start.data() : coming_.payload.data() + filled_;
    const std::size_t most = in_header ? header_bytes - header_.size() : coming_.payload.size() - filled_;
    const ssize_t count = ::read(file_, to, most);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return Got::closed;
    if (!in_header) {
      filled_ += static_cast<std::size_t>(count);
      continue;
    }
    header_.append(start.data(), static_cast<std::size_t>(count));
    if (header_.size() < header_bytes) continue;
    const std::size_t bytes = number_of(std::string_view(header_).substr(0, 4));
    if (bytes > most_payload_bytes) return Got::closed;
    coming_ = {static_cast<FrameKind>(number_of(std::string_view(header_).substr(4))), std::string(bytes, '\0')};
  }
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool write_frame(int file, FrameKind kind, std::string_view payload) {
  return write_all(file, header_of(kind, payload.size())) && write_all(file, payload);
}

}  // namespace aplomb::studio
