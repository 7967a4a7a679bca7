#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aplomb/adapters/openvdb/field_operations.h"
#include "aplomb/carve/void_field.h"

namespace aplomb {

using openvdb::Coord;

namespace {

Coord rounded(Vec3 at) {
  return {static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)),
          static_cast<int>(std::lround(at.z))};
}

/// The deepest point of the void within two lattice points of a place.
Coord deepest_near(const adapters::FieldReader& values, const Coord& place) {
  constexpr int reach = 2, side = 2 * reach + 1;
  Coord deepest = place;
  for (int n = 0; n < side * side * side; ++n) {
    const Coord at = place.offsetBy(n % side - reach, n / side % side - reach, n / (side * side) - reach);
    if (values.getValue(at) < values.getValue(deepest)) deepest = at;
  }
  return deepest;
}

}  // namespace

SolidVolume without_part(const SolidVolume& volume, const VoidField& field, Vec3 seed_mm, double below_mm) {
  const VoxelFrame frame = volume.frame();
  const adapters::FieldReader values(field.impl().field->tree());
  auto region = volume.impl().field->deepCopy();
  const auto height = [&](const Coord& at) { return frame.position_mm({at[0], at[1], at[2]}).z; };
  openvdb::MaskTree reached;
  std::vector<Coord> front;
  const auto reach = [&](const Coord& at) {
    if (!(values.getValue(at) < 0) || height(at) >= below_mm || reached.isValueOn(at)) return;
    reached.setValueOn(at);
    front.push_back(at);
  };
  reach(deepest_near(values, rounded((seed_mm - frame.origin_mm) / frame.voxel_mm)));
  while (!front.empty()) {
    const Coord at = front.back();
    front.pop_back();
    const double above = std::min(below_mm - height(at), 2 * frame.voxel_mm);
    const float raised = std::min(region->background(), static_cast<float>(above));
    region->tree().setValueOnly(at, std::max(region->tree().getValue(at), raised));
    for (const Coord& step :
         std::array<Coord, 6>{Coord{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
      reach(at + step);
  }
  adapters::split_tiles_at_the_rim(region->tree());
  return SolidVolume(
      std::make_shared<SolidVolume::Impl>(SolidVolume::Impl{frame, volume.options(), std::move(region)}));
}

}  // namespace aplomb
