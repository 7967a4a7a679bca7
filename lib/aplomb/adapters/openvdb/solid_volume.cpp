#include "aplomb/volume/solid_volume.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/adapters/openvdb/field_operations.h"
#include "aplomb/core/pulse.h"
#include "aplomb/mesh/clipped_tetrahedron.h"
#include "aplomb/volume/carvable_blocks.h"
#include "aplomb/volume/void_anchors.h"

namespace aplomb {

using adapters::FieldLeaf;
using adapters::FieldTree;
using adapters::SurfaceDistance;
using openvdb::Coord;

namespace {

constexpr int root_size = 32;  // lattice points per side of the octree's roots
constexpr double most_voxels_a_side = 1e9;
constexpr double exact_reach = 1.75;   // voxels: more than the diagonal of a cell
constexpr double opening_slack = 0.5;  // voxels

/// What carving keeps away from: the surface, and the lines that hold the voids the solid already has.
class Kept {
 public:
  explicit Kept(const SolidMesh& solid) : surface_(solid.mesh()), anchors_(void_anchors(solid)) {}

  SurfaceDistance::Closest closest(Vec3 point, std::uint32_t hint, double near_enough_mm) const {
    auto nearest = surface_.closest(point, hint, near_enough_mm);
    for (const VoidAnchor& anchor : anchors_)
      nearest.distance_mm = std::min(nearest.distance_mm, anchor.distance_mm(point));
    return nearest;
  }
  bool inside(Vec3 point, const SurfaceDistance::Closest& nearest) const { return surface_.inside(point, nearest); }

 private:
  SurfaceDistance surface_;
  std::vector<VoidAnchor> anchors_;
};

/// The octree's descent from one root: leaves and whole inside blocks of the field.
class Sampler {
 public:
  struct Block {
    Coord origin;
    std::unique_ptr<FieldLeaf> leaf;  // none: inside altogether
  };

  Sampler(const Kept& kept, const VoxelFrame& frame, double depth_mm, double background_mm)
      : kept_(kept), frame_(frame), depth_mm_(depth_mm), background_mm_(background_mm) {}

  std::vector<Block> sample(const Coord& root) {
    descend(root, root_size, SurfaceDistance::no_triangle);
    return std::move(blocks_);
  }

 private:
  enum class Decision { outside, inside, mixed };

  /// The points origin + [0, size)^3.
  Decision decide(const Coord& origin, int size, SurfaceDistance::Closest& nearest, std::uint32_t hint) const {
    const double h = frame_.voxel_mm, half = 0.5 * (size - 1);
    const Vec3 centre = frame_.position_mm({origin[0], origin[1], origin[2]}) + h * half * Vec3{1, 1, 1};
    const double reach = std::sqrt(3.0) * half * h, outside_to = depth_mm_ - exact_reach * h - reach;
    nearest = kept_.closest(centre, hint, std::max(0.0, outside_to));
    const double d = nearest.distance_mm;
    if (d <= outside_to) return Decision::outside;
    if (d <= reach) return Decision::mixed;
    if (!kept_.inside(centre, nearest)) return Decision::outside;
    return d - reach >= depth_mm_ + background_mm_ ? Decision::inside : Decision::mixed;
  }

  void descend(const Coord& origin, int size, std::uint32_t hint) {
    SurfaceDistance::Closest nearest;
    const Decision decision = decide(origin, size, nearest, hint);
    if (decision == Decision::outside) return;
    if (decision == Decision::inside) return fill_inside(origin, size);
    if (size > adapters::leaf_size) {
      for (int c = 0; c < 8; ++c) descend(child(origin, size / 2, c), size / 2, nearest.triangle);
      return;
    }
    leaf_ = std::make_unique<FieldLeaf>(origin, static_cast<float>(background_mm_), false);
    for (int c = 0; c < 8; ++c) descend_leaf(child(origin, size / 2, c), size / 2, nearest.triangle);
    const float* values = leaf_->buffer().data();
    const auto in_band = [&](float value) { return value < static_cast<float>(background_mm_); };
    if (std::any_of(values, values + FieldLeaf::SIZE, in_band)) blocks_.push_back({origin, std::move(leaf_)});
  }

  void descend_leaf(const Coord& origin, int size, std::uint32_t hint) {
    SurfaceDistance::Closest nearest;
    const Decision decision = decide(origin, size, nearest, hint);
    if (decision == Decision::outside) return;
    if (size == 1) return set(origin, depth_mm_ - signed_depth(origin, nearest));
    if (decision == Decision::mixed) {
      for (int c = 0; c < 8; ++c) descend_leaf(child(origin, size / 2, c), size / 2, nearest.triangle);
      return;
    }
    for (int n = 0; n < size * size * size; ++n)
      set(origin.offsetBy(n / (size * size), n / size % size, n % size), -background_mm_);
  }

  double signed_depth(const Coord& at, const SurfaceDistance::Closest& nearest) const {
    const Vec3 point = frame_.position_mm({at[0], at[1], at[2]});
    return kept_.inside(point, nearest) ? nearest.distance_mm : -nearest.distance_mm;
  }

  void set(const Coord& at, double value) {
    leaf_->setValueOnly(at, static_cast<float>(std::clamp(value, -background_mm_, background_mm_)));
  }

  void fill_inside(const Coord& origin, int size) {
    for (int i = 0; i < size; i += adapters::leaf_size)
      for (int j = 0; j < size; j += adapters::leaf_size)
        for (int k = 0; k < size; k += adapters::leaf_size) blocks_.push_back({origin.offsetBy(i, j, k), nullptr});
  }

  static Coord child(const Coord& origin, int half, int c) {
    return origin.offsetBy(half * (c & 1), half * (c >> 1 & 1), half * (c >> 2 & 1));
  }

  const Kept& kept_;
  const VoxelFrame frame_;
  const double depth_mm_;
  const double background_mm_;
  std::unique_ptr<FieldLeaf> leaf_;
  std::vector<Block> blocks_;
};

std::vector<Coord> root_origins(const Box3& box, const VoxelFrame& frame) {
  std::array<int, 3> count{};
  for (int axis = 0; axis < 3; ++axis)
    count[axis] = 1 + static_cast<int>(std::ceil((box.max[axis] - frame.origin_mm[axis]) / frame.voxel_mm)) / root_size;
  std::vector<Coord> roots;
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k) roots.emplace_back(root_size * i, root_size * j, root_size * k);
  return roots;
}

Result<openvdb::FloatGrid::Ptr> sample_field(const SolidMesh& solid, const VoxelFrame& frame, double depth_mm,
                                             double background_mm, const Job& job) {
  const Kept kept(solid);
  const std::vector<Coord> roots = root_origins(solid.box(), frame);
  auto grid = openvdb::FloatGrid::create(static_cast<float>(background_mm));
  const auto batch = 2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());  // some 10 ms
  for (std::size_t begin = 0; begin < roots.size(); begin += batch) {
    if (!job.report(double(begin) / double(roots.size()), "voxelize")) return cancelled();
    std::vector<std::vector<Sampler::Block>> parts(std::min(batch, roots.size() - begin));
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      parts[i] = Sampler(kept, frame, depth_mm, background_mm).sample(roots[begin + i]);
    });
    for (auto& blocks : parts)
      for (Sampler::Block& block : blocks) {
        if (block.leaf) grid->tree().addLeaf(block.leaf.release());
        else grid->tree().addTile(1, block.origin, static_cast<float>(-background_mm), true);
      }
  }
  return grid;
}

double surface_area_mm2(const TriangleMesh& mesh) {
  double twice = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]];
    twice += norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
  }
  return 0.5 * twice;
}

}  // namespace

std::string find_problem(const VolumeOptions& o) {
  if (!(o.wall_mm > 0 && o.wall_mm <= 1e4)) return fmt::format("wall_mm is {}; it must lie in (0, 10000]", o.wall_mm);
  if (!(o.voxel_mm > 0 && o.voxel_mm <= 0.5 * o.wall_mm))
    return fmt::format("voxel_mm is {}; it must lie in (0, {}], half the wall", o.voxel_mm, 0.5 * o.wall_mm);
  if (!(o.least_void_mm >= 0 && o.least_void_mm <= 32 * o.voxel_mm))
    return fmt::format("least_void_mm is {}; it must lie in [0, {}], 32 voxels", o.least_void_mm, 32 * o.voxel_mm);
  if (o.memory_bytes == 0) return "memory_bytes is 0; it must be positive";
  return {};
}

std::size_t estimated_bytes(const SolidMesh& solid, const VolumeOptions& options) {
  // Measured: a boundary cell of the region costs about 0.5 kB through field, cut, tetrahedra and shell; the region's
  // boundary is no larger than the surface but for deep folds. Whole inside blocks cost 16 bytes for 512 cells.
  const double h = options.voxel_mm;
  const double cells = surface_area_mm2(solid.mesh()) / (h * h);
  const double blocks = solid.moments().volume_mm3 / (512 * h * h * h);
  const double bytes = 600 * cells + 64 * blocks + 1000.0 * double(solid.mesh().triangles.size());
  // Of a needle, the box: a list of the octree's roots, and voxels that an int can number.
  double roots = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double voxels = solid.box().size()[axis] / h;
    roots *= voxels < most_voxels_a_side ? 1 + voxels / root_size : 1e18;
  }
  return static_cast<std::size_t>(std::min(std::max(bytes, sizeof(Coord) * roots), 1e18));
}

Result<SolidVolume> voxelize(const SolidMesh& solid, const VolumeOptions& options, const Job& job) {
  assert(find_problem(options).empty());
  const std::size_t bytes = estimated_bytes(solid, options);
  if (bytes > options.memory_bytes)
    return fail(ErrorCode::over_budget,
                fmt::format("a voxel of {:.3g} mm would take about {} MB, and {} MB are allowed: allow more memory or "
                            "take a larger voxel",
                            options.voxel_mm, bytes >> 20, options.memory_bytes >> 20));
  openvdb::initialize();
  const double h = options.voxel_mm;
  const VoxelFrame frame{h, solid.box().min};
  const double depth = carving_depth_mm(options);
  const double background = std::max(0.5 * options.least_void_mm + h, exact_reach * h);
  auto grid = sample_field(solid, frame, depth, background, job.part(0, 0.7));
  if (!grid) return tl::unexpected(grid.error());
  const Pulse pulse(job, 0.7, "voxelize");
  adapters::open_by_ball((*grid)->tree(), 0.5 * options.least_void_mm, opening_slack * h, h, pulse);
  if (pulse.stopped()) return cancelled();
  return SolidVolume(std::make_shared<SolidVolume::Impl>(SolidVolume::Impl{frame, options, *grid}));
}

double carving_depth_mm(const VolumeOptions& options) {
  const double h = options.voxel_mm;
  return std::sqrt(options.wall_mm * options.wall_mm + 0.75 * h * h) + shell_slack_voxels * h;
}

const VoxelFrame& SolidVolume::frame() const { return impl_->frame; }
const VolumeOptions& SolidVolume::options() const { return impl_->options; }
std::size_t SolidVolume::stored_points() const { return impl_->field->tree().leafCount() * FieldLeaf::SIZE; }
std::size_t SolidVolume::memory_bytes() const { return impl_->field->memUsage(); }

std::vector<CarvableBlock> carvable_blocks(const SolidVolume& volume, const Pulse& pulse) {
  const FieldTree& field = volume.impl().field->tree();
  const adapters::Blocks origins = adapters::field_blocks(field);
  std::vector<CarvableBlock> blocks(origins.mixed.size());
  const auto fill = [&](std::size_t n) {
    const Coord& origin = origins.mixed[n];
    blocks[n].origin = {origin[0], origin[1], origin[2]};
    const adapters::CornerValues corners = adapters::corner_values(adapters::FieldReader(field), origin);
    if (std::ranges::none_of(corners, [](float v) { return v < 0; })) return;
    blocks[n].shares.resize(CarvableBlock::cells);
    for (int cell = 0; cell < CarvableBlock::cells; ++cell) {
      const auto values = adapters::cell_values(corners, cell / 64, cell / 8 % 8, cell % 8);
      const auto negative = std::ranges::count_if(values, [](double v) { return v < 0; });
      blocks[n].shares[cell] = negative == 0   ? 0.0f
                               : negative == 8 ? 1.0f
                                               : static_cast<float>(negative_part_of_unit_cube(values).volume_mm3);
    }
  };
  constexpr std::size_t batch = 512;  // some 20 ms
  for (std::size_t begin = 0; begin < blocks.size() && pulse.goes_on(20'000); begin += batch)
    tbb::parallel_for(begin, std::min(begin + batch, blocks.size()), fill);
  std::erase_if(blocks, [](const CarvableBlock& block) {
    return std::ranges::all_of(block.shares, [](float share) { return share == 0; });
  });
  for (const Coord& origin : origins.full) blocks.push_back({{origin[0], origin[1], origin[2]}, {}});
  return blocks;
}

}  // namespace aplomb
