#include "solver/outbox.h"

#include "wire/frames.h"
#include "wire/messages.h"

namespace aplomb::studio {

void Outbox::json(std::string_view message) { write_frame(file_, FrameKind::json, message); }
void Outbox::mesh(std::string_view name, const TriangleMesh& mesh) {
  write_frame(file_, FrameKind::mesh, mesh_payload(name, mesh));
}
void Outbox::positions(std::span<const Vec3> vertices) {
  write_frame(file_, FrameKind::positions, positions_payload(vertices));
}
void Outbox::end() { write_frame(file_, FrameKind::end, {}); }

Job Outbox::work(bool tells_progress) {
  return Job([this, tells_progress](double fraction, std::string_view stage) {
    const auto now = std::chrono::steady_clock::now();
    if (tells_progress && now - told_ >= std::chrono::milliseconds(50)) {
      told_ = now;
      json(progress_message(fraction, stage));
    }
    return !is_cancelled();
  });
}

}  // namespace aplomb::studio
