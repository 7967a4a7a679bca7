#include "aplomb/io/detail/vertex_index.h"

#include <chrono>

namespace aplomb::detail {

VertexIndex::VertexIndex(GrowingMesh& mesh, const ReadContext& context)
    : mesh_(&mesh),
      context_(&context),
      seed_(mixed(static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count()) ^
                  reinterpret_cast<std::uintptr_t>(&mesh))),
      mask_(1023),
      table_(mask_ + 1) {}

bool VertexIndex::add(Vec3 position, std::size_t slot, std::uint32_t tag, std::uint32_t& index) {
  index = static_cast<std::uint32_t>(mesh_->mesh().vertices.size());
  if (!mesh_->add_vertex(position)) {
    failure_ = mesh_->failure().value();
    return false;
  }
  table_[slot] = {index, tag};
  return mesh_->mesh().vertices.size() * 2 <= table_.size() || grow();
}

bool VertexIndex::grow() {
  const std::size_t next = table_.size() * 4;
  const TriangleMesh& mesh = mesh_->mesh();
  const auto admitted =
      context_->admit(mesh.vertices.capacity(), mesh.triangles.capacity(), (table_.size() + next) * sizeof(Entry));
  if (!admitted) {
    failure_ = admitted.error();
    return false;
  }
  std::vector<Entry> larger(next);
  mask_ = next - 1;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    const std::uint64_t hash = hash_of(mesh.vertices[i]);
    std::size_t slot = hash & mask_;
    while (larger[slot].index != kEmpty) slot = (slot + 1) & mask_;
    larger[slot] = {i, static_cast<std::uint32_t>(hash >> 32)};
  }
  table_ = std::move(larger);
  return true;
}

Result<TriangleMesh> indexed_by_position(const TriangleMesh& soup, const ReadContext& context) {
  GrowingMesh mesh(context);
  VertexIndex index(mesh, context);
  for (const Triangle& corners : soup.triangles) {
    Triangle merged;
    for (int corner = 0; corner < 3; ++corner)
      if (!index.find_or_add(soup.vertices[corners[corner]], merged[corner])) return index.failure();
    if (!mesh.add_triangle(merged)) return mesh.failure();
  }
  return mesh.take();
}

}  // namespace aplomb::detail
