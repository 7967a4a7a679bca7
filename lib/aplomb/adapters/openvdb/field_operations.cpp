#include "aplomb/adapters/openvdb/field_operations.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "aplomb/mesh/clipped_tetrahedron.h"

namespace aplomb::adapters {

using openvdb::Coord;

CornerValues corner_values(const FieldReader& reader, const Coord& origin) {
  CornerValues values;
  for (int i = 0; i < corner_size; ++i)
    for (int j = 0; j < corner_size; ++j)
      for (int k = 0; k < corner_size; ++k) values[corner_offset(i, j, k)] = reader.getValue(origin.offsetBy(i, j, k));
  return values;
}

std::array<double, 8> cell_values(const CornerValues& corners, int i, int j, int k) {
  std::array<double, 8> values;
  for (int c = 0; c < 8; ++c) values[c] = corners[corner_offset(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1))];
  return values;
}

Blocks field_blocks(const FieldTree& field) {
  Blocks blocks;
  for (auto leaf = field.cbeginLeaf(); leaf; ++leaf) blocks.mixed.push_back(leaf->origin());
  auto tile = field.cbeginValueOn();
  tile.setMaxDepth(FieldTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) blocks.full.push_back(tile.getCoord());
  return blocks;
}

namespace {

/// Whether a lattice point past the block's upper faces, which its cells have as corners, is positive.
bool is_open_above(const FieldReader& reader, const Coord& origin) {
  for (int i = 0; i <= leaf_size; ++i)
    for (int j = 0; j <= leaf_size; ++j)
      for (int k = std::max(i, j) == leaf_size ? 0 : leaf_size; k <= leaf_size; ++k)
        if (reader.getValue(origin.offsetBy(i, j, k)) > 0) return true;
  return false;
}

}  // namespace

void split_tiles_at_the_rim(FieldTree& field) {
  const FieldReader reader(field);
  std::vector<Coord> split;
  for (const Coord& origin : field_blocks(field).full)
    if (is_open_above(reader, origin)) split.push_back(origin);
  for (const Coord& origin : split)
    field.addLeaf(std::make_unique<FieldLeaf>(origin, field.getValue(origin), false).release());
}

namespace {

/// Moments of a block in units of the lattice.
Moments block_moments(const FieldReader& reader, const Coord& origin) {
  const CornerValues corners = corner_values(reader, origin);
  Moments sum;
  for (int i = 0; i < leaf_size; ++i)
    for (int j = 0; j < leaf_size; ++j)
      for (int k = 0; k < leaf_size; ++k) {
        const std::array<double, 8> values = cell_values(corners, i, j, k);
        const auto negative = std::ranges::count_if(values, [](double v) { return v < 0; });
        if (negative == 0) continue;
        const Vec3 least{double(origin[0] + i), double(origin[1] + j), double(origin[2] + k)};
        const Moments cell = negative == 8 ? Moments{1, {0.5, 0.5, 0.5}} : negative_part_of_unit_cube(values);
        sum += {cell.volume_mm3, cell.first_mm4 + cell.volume_mm3 * least};
      }
  return sum;
}

}  // namespace

Moments field_moments(const FieldTree& field, const VoxelFrame& frame) {
  const Blocks blocks = field_blocks(field);
  std::vector<Moments> parts(blocks.mixed.size());
  tbb::parallel_for(std::size_t{0}, parts.size(),
                    [&](std::size_t i) { parts[i] = block_moments(FieldReader(field), blocks.mixed[i]); });
  Moments sum;  // one after the other: the same sum whatever the threads
  for (const Moments& part : parts) sum += part;
  for (const Coord& origin : blocks.full) {
    const double cells = leaf_size * leaf_size * leaf_size;
    const Vec3 middle = Vec3{double(origin[0]), double(origin[1]), double(origin[2])} + Vec3{4, 4, 4};
    sum += {cells, cells * middle};
  }
  const double h = frame.voxel_mm, volume = h * h * h * sum.volume_mm3;
  return {volume, volume * frame.origin_mm + h * h * h * h * sum.first_mm4};
}

void push_from_zero(FieldTree& field, float gap) {
  for (auto leaf = field.beginLeaf(); leaf; ++leaf)
    for (openvdb::Index n = 0; n < FieldLeaf::SIZE; ++n)
      if (std::abs(leaf->getValue(n)) < gap) leaf->setValueOnly(n, gap);
}

}  // namespace aplomb::adapters
