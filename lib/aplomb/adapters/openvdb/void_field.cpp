#include "aplomb/carve/void_field.h"

#include <algorithm>
#include <cmath>

#include "aplomb/adapters/openvdb/field_operations.h"
#include "aplomb/volume/carvable_blocks.h"

namespace aplomb {

using adapters::FieldLeaf;
using adapters::FieldTree;
using openvdb::Coord;

namespace {

/// Distance in mm to the plane at lattice points, negative on the side that is carved.
class Plane {
 public:
  Plane(const AffineForm& kept, const VoxelFrame& frame) {
    const double length = norm(kept.gradient);
    if (length > 0) {
      gradient_ = (frame.voxel_mm / length) * kept.gradient;
      constant_ = kept(frame.origin_mm) / length;
    } else {
      constant_ = kept.constant > 0 ? 1e9 : -1e9;  // all kept or all carved
    }
  }
  double at(const Coord& p) const { return constant_ + gradient_.x * p[0] + gradient_.y * p[1] + gradient_.z * p[2]; }
  /// Over the lattice points of a block and the corners past it.
  double least(const Coord& origin) const { return centre(origin) - reach(); }
  double greatest(const Coord& origin) const { return centre(origin) + reach(); }

 private:
  double centre(const Coord& origin) const { return at(origin) + 4 * (gradient_.x + gradient_.y + gradient_.z); }
  double reach() const { return 4 * (std::abs(gradient_.x) + std::abs(gradient_.y) + std::abs(gradient_.z)); }

  Vec3 gradient_;
  double constant_ = 0;
};

/// max(field, plane), clamped to the background; blocks on the kept side are left out.
openvdb::FloatGrid::Ptr cut_field(const openvdb::FloatGrid& region, const Plane& plane) {
  const float background = region.background();
  auto cut = openvdb::FloatGrid::create(background);
  const auto add_leaf = [&](const Coord& origin, const auto& value_at) {
    auto leaf = std::make_unique<FieldLeaf>(origin, background, false);
    for (openvdb::Index n = 0; n < FieldLeaf::SIZE; ++n) {
      const auto plane_value = static_cast<float>(plane.at(leaf->offsetToGlobalCoord(n)));
      leaf->setValueOnly(n, std::min(background, std::max(value_at(n), plane_value)));
    }
    cut->tree().addLeaf(leaf.release());
  };
  for (auto leaf = region.tree().cbeginLeaf(); leaf; ++leaf) {
    if (plane.least(leaf->origin()) >= background) continue;
    add_leaf(leaf->origin(), [&](openvdb::Index n) { return leaf->getValue(n); });
  }
  for (const Coord& origin : adapters::field_blocks(region.tree()).full) {
    if (plane.least(origin) >= background) continue;
    if (plane.greatest(origin) <= -background) cut->tree().addTile(1, origin, -background, true);
    else add_leaf(origin, [&](openvdb::Index) { return -background; });
  }
  return cut;
}

/// The region without what was dropped from the void: there, the void is not and the cut alone would have been.
SolidVolume without_dropped(const SolidVolume& volume, const FieldTree& before, const FieldTree& after) {
  auto field = volume.impl().field->deepCopy();
  for (auto leaf = before.cbeginLeaf(); leaf; ++leaf)
    for (openvdb::Index n = 0; n < FieldLeaf::SIZE; ++n) {
      const Coord at = leaf->offsetToGlobalCoord(n);
      if (leaf->getValue(n) < 0 && after.getValue(at) > 0) field->tree().setValueOnly(at, after.getValue(at));
    }
  for (const Coord& origin : adapters::field_blocks(before).full)
    if (after.getValue(origin) > 0)  // a leaf, for its cells may reach up to what is still carved
      field->tree().addLeaf(std::make_unique<FieldLeaf>(origin, field->background(), false).release());
  adapters::split_tiles_at_the_rim(field->tree());
  return SolidVolume(
      std::make_shared<SolidVolume::Impl>(SolidVolume::Impl{volume.frame(), volume.options(), std::move(field)}));
}

}  // namespace

Result<VoidCut> cut_void(const SolidVolume& volume, const AffineForm& kept, double least_volume_mm3, const Job& job) {
  const VoxelFrame frame = volume.frame();
  const double h = frame.voxel_mm;
  auto field = cut_field(*volume.impl().field, Plane(kept, frame));
  const Pulse pulse(job, 1, "carve");
  adapters::open_by_ball(field->tree(), 0.5 * volume.options().least_void_mm, 0.5 * h, h, pulse);
  const auto least_points = static_cast<std::size_t>(std::ceil(least_volume_mm3 / (h * h * h)));
  const auto before = field->deepCopy();
  const adapters::DroppedParts dropped = adapters::drop_small_parts(field->tree(), least_points, pulse);
  if (pulse.stopped()) return cancelled();
  adapters::push_from_zero(field->tree(), static_cast<float>(0.05 * h));
  const Moments moments = adapters::field_moments(field->tree(), frame);
  VoidCut cut{VoidField(std::make_shared<VoidField::Impl>(VoidField::Impl{frame, field}), moments), dropped.parts,
              double(dropped.points) * h * h * h, std::nullopt};
  if (dropped.parts > 0) cut.without_dropped = without_dropped(volume, before->tree(), field->tree());
  return cut;
}

const VoxelFrame& VoidField::frame() const { return impl_->frame; }

std::vector<CornerCell> boundary_cells(const VoidField& field, const Pulse& pulse) {
  const FieldTree& tree = field.impl().field->tree();
  const adapters::FieldReader reader(tree);
  std::vector<CornerCell> cells;
  for (const Coord& origin : adapters::field_blocks(tree).mixed) {
    if (!pulse.goes_on(20)) break;
    const adapters::CornerValues corners = adapters::corner_values(reader, origin);
    for (int cell = 0; cell < CarvableBlock::cells; ++cell) {
      const int i = cell / 64, j = cell / 8 % 8, k = cell % 8;
      const auto values = adapters::cell_values(corners, i, j, k);
      const auto negative = std::ranges::count_if(values, [](double v) { return v < 0; });
      if (negative == 0 || negative == 8) continue;
      CornerCell& out = cells.emplace_back(CornerCell{{origin[0] + i, origin[1] + j, origin[2] + k}, {}});
      std::ranges::transform(values, out.values.begin(), [](double v) { return static_cast<float>(v); });
    }
  }
  return cells;
}

}  // namespace aplomb
