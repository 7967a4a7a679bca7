#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "aplomb/io/detail/read_context.h"

namespace aplomb::detail {

/// Gives corners at exactly equal positions the same vertex, in order of first appearance (0 and -0 are equal).
/// A hash table of the caller's mesh; seeded, so that no file can be made to collide.
class VertexIndex {
 public:
  VertexIndex(GrowingMesh& mesh, const ReadContext& context);

  /// Nothing when the budget is spent; then failure() says why.
  [[nodiscard]] bool find_or_add(Vec3 position, std::uint32_t& index) {
    position = position + Vec3{};  // -0 becomes 0
    const std::uint64_t hash = hash_of(position);
    const std::uint32_t tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t slot = hash & mask_;; slot = (slot + 1) & mask_) {
      const Entry& entry = table_[slot];
      if (entry.index == kEmpty) return add(position, slot, tag, index);
      if (entry.tag == tag && mesh_->mesh().vertices[entry.index] == position) {
        index = entry.index;
        return true;
      }
    }
  }
  tl::unexpected<Error> failure() const { return tl::unexpected<Error>(failure_); }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffff;
  struct Entry {
    std::uint32_t index = kEmpty;
    std::uint32_t tag = 0;
  };

  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93u;
    return x ^ (x >> 32);
  }
  std::uint64_t hash_of(Vec3 p) const {
    std::uint64_t hash = seed_;
    for (int axis = 0; axis < 3; ++axis)
      hash = mixed(hash ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9e3779b97f4a7c15u;
    return mixed(hash);
  }
  bool add(Vec3 position, std::size_t slot, std::uint32_t tag, std::uint32_t& index);
  bool grow();

  GrowingMesh* mesh_;
  const ReadContext* context_;
  std::uint64_t seed_;
  std::size_t mask_;
  std::vector<Entry> table_;
  Error failure_;
};

/// The same surface with corners at equal positions made one vertex. \return over_budget.
Result<TriangleMesh> indexed_by_position(const TriangleMesh& soup, const ReadContext& context);

}  // namespace aplomb::detail
