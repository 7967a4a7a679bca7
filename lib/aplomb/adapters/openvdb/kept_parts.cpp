#include "aplomb/carve/kept_parts.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "aplomb/adapters/openvdb/field_operations.h"

namespace aplomb {

using adapters::FieldLeaf;
using openvdb::Coord;

namespace {

/// Parts whose boxes a block of lattice points meets.
class PartsNear {
 public:
  PartsNear(const std::vector<KeptPart>& parts, const VoxelFrame& frame, double margin_mm)
      : parts_(parts), frame_(frame), margin_mm_(margin_mm) {}

  std::vector<const KeptPart*> of_block(const Coord& origin) const {
    const Vec3 least = frame_.position_mm({origin[0], origin[1], origin[2]});
    const double side = (adapters::leaf_size - 1) * frame_.voxel_mm;
    std::vector<const KeptPart*> near;
    for (const KeptPart& part : parts_) {
      bool meets = true;
      for (int axis = 0; axis < 3; ++axis)
        meets &= part.box_mm.min[axis] - margin_mm_ <= least[axis] + side &&
                 part.box_mm.max[axis] + margin_mm_ >= least[axis];
      if (meets) near.push_back(&part);
    }
    return near;
  }

  double depth_mm(const std::vector<const KeptPart*>& near, const Coord& at) const {
    const Vec3 point = frame_.position_mm({at[0], at[1], at[2]});
    double depth = -margin_mm_;
    for (const KeptPart* part : near) depth = std::max(depth, part->depth_mm(point));
    return std::min(depth, margin_mm_);
  }

 private:
  const std::vector<KeptPart>& parts_;
  const VoxelFrame frame_;
  const double margin_mm_;
};

}  // namespace

SolidVolume without(const SolidVolume& volume, const std::vector<KeptPart>& parts) {
  auto field = volume.impl().field->deepCopy();
  const float background = field->background();
  const PartsNear kept(parts, volume.frame(), background);
  for (const Coord& origin : adapters::field_blocks(field->tree()).full) {  // those that may change become leaves
    if (kept.of_block(origin).empty()) continue;
    field->tree().addLeaf(new FieldLeaf(origin, -background, false));
  }
  const std::vector<Coord> blocks = adapters::field_blocks(field->tree()).mixed;
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
    const auto near = kept.of_block(blocks[i]);
    if (near.empty()) return;
    FieldLeaf* leaf = field->tree().probeLeaf(blocks[i]);
    for (openvdb::Index n = 0; n < FieldLeaf::SIZE; ++n)
      if (const float value = leaf->getValue(n); value < background)
        leaf->setValueOnly(n, std::max(value, static_cast<float>(kept.depth_mm(near, leaf->offsetToGlobalCoord(n)))));
  });
  return SolidVolume(
      std::make_shared<SolidVolume::Impl>(SolidVolume::Impl{volume.frame(), volume.options(), std::move(field)}));
}

}  // namespace aplomb
